#include "render/run/element_charts.hpp"

#include <functional>

namespace porosph::render {
namespace {

using Value = std::function<double(const ElementPath&, const ElementState&)>;

bool has_several_soils(const std::vector<ElementRun>& runs) {
  for (const ElementRun& run : runs)
    if (run.soil != runs.front().soil) return true;
  return false;
}

Chart chart_of(const std::vector<ElementRun>& runs, const std::string& title, const std::string& x_title,
               const std::string& y_title, const Value& x, const Value& y) {
  constexpr std::array<LineStyle, 4> styles{LineStyle::solid, LineStyle::dashed, LineStyle::dash_dotted,
                                            LineStyle::dotted};
  Chart chart{
      .title = title, .x = {.title = x_title}, .y = {.title = y_title}, .series = {}, .references = {}};
  const bool several = has_several_soils(runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    ChartSeries line{.label = runs.size() > 1 ? label_of(runs[i], several) : "",
                     .x = {},
                     .y = {},
                     .line = styles[i % styles.size()],
                     .end = LineEnd::stopped};
    for (const ElementState& state : runs[i].path.states) {
      line.x.push_back(x(runs[i].path, state));
      line.y.push_back(y(runs[i].path, state));
    }
    chart.series.push_back(std::move(line));
  }
  return chart;
}

std::string strain_title(ElementTest test) {
  if (is_shear(test)) return "shear strain γ [%]";
  if (test == ElementTest::isotropic) return "volume strain [%]";
  return "axial strain ε₁ [%]";
}

double strain(const ElementPath& path, const ElementState& s) { return 100 * path.strain(s); }
double volume(const ElementPath&, const ElementState& s) { return 100 * s.volume_compression(); }
double volume_change(const ElementPath&, const ElementState& s) { return -100 * s.volume_compression(); }
double pressure(const ElementPath&, const ElementState& s) { return s.mean_pressure() / 1e3; }
double axial(const ElementPath&, const ElementState& s) { return -s.stress.yy / 1e3; }
double deviator(const ElementPath& path, const ElementState& s) { return path.deviator(s) / 1e3; }
double shear(const ElementPath&, const ElementState& s) { return s.stress.xy / 1e3; }
double friction(const ElementPath&, const ElementState& s) { return s.mobilised_friction(); }
double pore_pressure(const ElementPath&, const ElementState& s) { return s.pore_pressure / 1e3; }

Chart last_chart(const std::vector<ElementRun>& runs, const std::string& along) {
  const ElementTest test = runs.front().path.setup.test;
  if (test == ElementTest::isotropic || test == ElementTest::oedometer) {
    const bool round = test == ElementTest::isotropic;
    Chart chart = chart_of(runs, "Compression", round ? "p' [kPa]" : "σ'₁ [kPa]", "change of volume [%]",
                           round ? pressure : axial, volume_change);
    chart.x.logarithmic = true;
    return chart;
  }
  if (is_undrained(test)) return chart_of(runs, "Pore pressure", along, "u [kPa]", strain, pore_pressure);
  return chart_of(runs, "Mobilised friction", along, "friction angle [degrees]", strain, friction);
}

}  // namespace

ChartFigure element_figure(const std::vector<ElementRun>& runs, const std::string& title) {
  const ElementTest test = runs.front().path.setup.test;
  const std::string along = strain_title(test);
  ChartFigure figure{.title = title, .charts = {}, .columns = 2};
  figure.charts.push_back(chart_of(runs, "Stress path", "p' [kPa]", "q [kPa]", pressure, deviator));
  if (is_shear(test))
    figure.charts.push_back(chart_of(runs, "Shear stress", along, "τ [kPa]", strain, shear));
  else if (test == ElementTest::isotropic)
    figure.charts.push_back(chart_of(runs, "Pressure", along, "p' [kPa]", strain, pressure));
  else if (test == ElementTest::oedometer)
    figure.charts.push_back(chart_of(runs, "Axial stress", along, "σ'₁ [kPa]", strain, axial));
  else
    figure.charts.push_back(chart_of(runs, "Deviator stress", along, "q [kPa]", strain, deviator));
  figure.charts.push_back(chart_of(runs, "Volume strain", along, "volume compression [%]", strain, volume));
  figure.charts.push_back(last_chart(runs, along));
  return figure;
}

}  // namespace porosph::render
