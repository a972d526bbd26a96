// porosph render: draws pictures of a series.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <optional>

#include "app/command.hpp"
#include "app/field_help.hpp"
#include "app/numbers.hpp"
#include "app/picture_options.hpp"
#include "app/range.hpp"
#include "render/run/run_panel.hpp"
#include "render/run/shown_field.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::app {

using namespace render;

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::string series, label, field, out, range, scale, map, style, arrows;
  std::vector<std::string> times;
  bool crosses = false;
  double deformation = 1, rate = 10;
  int width = 0, height = 0;
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  po::options_description options;
  options.add_options()("series", po::value(&o.series)->required(), "a .pvd, or the folder of a run")(
      "field", po::value(&o.field)->value_name("NAME[:COMPONENT]")->required(), field_help().c_str())(
      "time", po::value(&o.times)->value_name("T|last|all"),
      "the frame nearest to T seconds, the last frame (the default), or a picture of every frame; given "
      "again: "
      "one picture with a panel each")("label", po::value(&o.label)->value_name("TEXT"),
                                       "what to call the run in the picture (default: nothing)")(
      "out", po::value(&o.out)->value_name("FILE.png"),
      "the picture: .png, .svg or .pdf, or with --time all a film: .webp (default: PNG beside the series, "
      "named by the "
      "field)")("rate", po::value(&o.rate)->value_name("N")->default_value(10),
                "pictures per second of a film")(
      "style", po::value(&o.style)->value_name("particles|bands|isolines")->default_value("particles"),
      "each particle in its colour, bands of colour with labelled isolines, or isolines on the particles")(
      "arrows", po::value(&o.arrows)->value_name("NAME"),
      "arrows of a vector on top: Displacement, Velocity, DarcyVelocity or HydraulicGradient")(
      "crosses", po::bool_switch(&o.crosses),
      "principal effective stresses on top: blue in compression, red in tension")(
      "range", po::value(&o.range)->value_name("LOW,HIGH"),
      "of the colours, in the unit of the colour bar (default: all values, rounded)")(
      "scale", po::value(&o.scale)->value_name("linear|logarithmic"),
      "of the colours; logarithmic: three decades up to the largest value, or a --range above zero (default: "
      "logarithmic for PlasticStrain, else linear)")(
      "deform", po::value(&o.deformation)->value_name("FACTOR")->default_value(1),
      "displacements are drawn this many times; 0 draws the start")(
      "map", po::value(&o.map)->value_name("viridis|cividis|cool_warm"),
      "colours (default: cool_warm for shear and sideways motion, else viridis)")(
      "width", po::value(&o.width)->value_name("PIXELS"), "of the picture (default: as it fits)")(
      "height", po::value(&o.height)->value_name("PIXELS"), "of the picture (default: as it fits)");
  po::positional_options_description positional;
  positional.add("series", 1);
  po::variables_map values;
  if (!parse(
          arguments, options, positional, "render SERIES.pvd --field NAME[:COMPONENT] [options]",
          "  porosph render results/foundation --field TotalStress:YY\n"
          "  porosph render results/foundation/particles.pvd --field Displacement --deform 20 --out u.png\n"
          "  porosph render results/foundation --field EffectiveStress:YY --time all --range -110,0\n"
          "  porosph render results/foundation --field Displacement:Y --time 0.1 --time last\n"
          "  porosph render results/foundation --field StressObliquity --style bands --crosses --out "
          "friction.svg\n",
          values))
    return std::nullopt;
  for (const auto& [name, size] : {std::pair{"width", o.width}, std::pair{"height", o.height}})
    if (values.count(name) > 0 && (size < 200 || size > 8000))
      throw UsageError(fmt::format("--{} = {}: must be from 200 to 8000 pixels", name, size));
  if (!std::isfinite(o.deformation)) throw UsageError("--deform must be a finite number");
  if (!o.scale.empty() && o.scale != "linear" && o.scale != "logarithmic")
    throw UsageError(fmt::format("--scale = {}: must be linear or logarithmic", o.scale));
  if (!(o.rate >= 0.1 && o.rate <= 60))
    throw UsageError(fmt::format("--rate = {:g}: must be from 0.1 to 60 pictures per second", o.rate));
  if (o.times.empty()) o.times = {"last"};
  if (o.times.size() > 1 && std::ranges::count(o.times, "all") > 0)
    throw UsageError("--time all is every frame already: give it alone");
  if (fs::path(o.out).extension() == ".webp" && o.times[0] != "all")
    throw UsageError(fmt::format("--out = {}: a film needs --time all", o.out));
  return o;
}

ColourMap read_map(const std::string& name, const FieldSelection& selection) {
  static const std::map<std::string, ColourMap> maps = {
      {"viridis", ColourMap::viridis}, {"cividis", ColourMap::cividis}, {"cool_warm", ColourMap::cool_warm}};
  if (name.empty()) return usual_map(selection);
  if (const auto found = maps.find(name); found != maps.end()) return found->second;
  throw UsageError(fmt::format("--map = {}: must be viridis, cividis or cool_warm", name));
}

std::vector<std::size_t> choose_frames(const Series& series, const std::vector<std::string>& times) {
  std::vector<std::size_t> chosen;
  for (const std::string& time : times)
    if (time == "all")
      for (std::size_t i = 0; i < series.frames.size(); ++i) chosen.push_back(i);
    else
      chosen.push_back(time == "last" ? series.frames.size() - 1
                                      : frame_at(series, read_number("--time", time)));
  return chosen;
}

fs::path picture_path(const Options& o, const FinishedRun& run, const FieldSelection& selection,
                      std::size_t frame) {
  fs::path path = o.out.empty() ? run.folder / (file_name(selection.text()) + ".png") : fs::path(o.out);
  require_picture_name(path);
  if (o.times[0] == "all")
    path.replace_filename(fmt::format("{}_{:06}{}", path.stem().string(), frame, path.extension().string()));
  return path;
}

bool is_film(const Options& o) { return fs::path(o.out).extension() == ".webp"; }

/// What the frames to be drawn span: all of it, and what the range of colours is made of.
struct Spread {
  double largest = 0;  ///< absolute
  std::vector<ValueRange> extents;
  std::vector<Point> corners;  ///< of boxes around what is shown, where a film needs them [m]
};

Spread spread_of(const FinishedRun& run, const std::vector<std::size_t>& frames,
                 const FieldSelection& selection, const Options& o) {
  Spread spread;
  for (std::size_t frame : frames) {
    const Frame read = frame_of(run, frame);
    const std::vector<double> values = values_of(read, selection);
    if (is_film(o))
      for (const Point& corner : shown_box(panel_of(run, read, values, o.deformation)))
        spread.corners.push_back(corner);
    spread.largest = std::max(spread.largest, largest_of(values));
    spread.extents.push_back(robust_extent(values));
  }
  return spread;
}

/// The range where none is given, and whether colours are logarithmic.
void set_range(ColourScale& scale, const Spread& spread, const Options& o, const FieldSelection& selection) {
  const bool given = scale.range.has_value();
  const bool wanted = o.scale.empty() ? usually_logarithmic(selection) && (!given || scale.range->low > 0)
                                      : o.scale == "logarithmic";
  if (!given) scale.range = range_of_instants(spread.extents, scale.map);
  if (!wanted) return;
  if (!given)
    make_logarithmic(scale);
  else if (!(scale.range->low > 0))
    throw UsageError(fmt::format("--range = {}: logarithmic colours need a range above zero", o.range));
  else
    scale.logarithmic = true;
}

/// Beside other times the panel's title is its time, as the figure's names the field.
void set_titles(ContourPanel& panel, const FinishedRun& run, std::size_t frame,
                const FieldSelection& selection, const Options& o) {
  const double time = run.series.frames[frame].time;
  const bool alone = o.times.size() == 1;
  panel.title = alone ? shown_name(selection) + (run.label.empty() ? "" : ", " + run.label) : time_text(time);
  if (alone) panel.subtitle = panel_subtitle(run, time, run.label);
  if (o.deformation == 1) return;
  panel.subtitle += fmt::format("{}displacements × {:g}", alone ? ", " : "", o.deformation);
}

/// The case's title; of several times with the field and the run's label.
std::string figure_title(const FinishedRun& run, const FieldSelection& selection, const Options& o) {
  const std::string title = run.scene ? run.scene->title : "";
  if (o.times.size() == 1) return title;
  std::string field = title.empty() ? shown_name(selection) : title + ": " + name_in_sentence(selection);
  return run.label.empty() ? field : field + ", " + run.label;
}

/// Adds what is drawn on top, and says so in the subtitle.
void add_marks(ContourPanel& panel, const Frame& frame, const Options& o) {
  if (!o.arrows.empty()) {
    const auto x = values_of(frame, {o.arrows, "X"}), y = values_of(frame, {o.arrows, "Y"});
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      panel.arrows.push_back({x[i], y[i]});
      largest = std::max(largest, std::hypot(x[i], y[i]));
    }
    const ShownUnit unit = shown_unit(o.arrows, largest);
    panel.subtitle += fmt::format(", arrows: {} up to {:.3g} {}", name_in_sentence({o.arrows, ""}),
                                  largest * unit.factor, unit.name);
  }
  if (o.crosses) {
    const auto xx = values_of(frame, {"EffectiveStress", "XX"}),
               yy = values_of(frame, {"EffectiveStress", "YY"}),
               xy = values_of(frame, {"EffectiveStress", "XY"});
    for (std::size_t i = 0; i < xx.size(); ++i) panel.crosses.push_back({xx[i], yy[i], 0, xy[i]});
    panel.subtitle += ", crosses: principal effective stress, tension red";
  }
}

void check_arrows(const std::string& field) {
  static const std::array<std::string_view, 4> vectors{"Displacement", "Velocity", "DarcyVelocity",
                                                       "HydraulicGradient"};
  if (!field.empty() && std::ranges::find(vectors, field) == vectors.end())
    throw UsageError(fmt::format("--arrows = {}: must be {}", field, fmt::join(vectors, ", ")));
}

/// Makes the folder, saves there, and tells where that is.
template <class Save>
void saved_at(const fs::path& path, Save&& save) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  save(path);
  std::cout << path.string() << '\n';
}

}  // namespace

int render_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  const FieldSelection selection = parse_selection(o->field);
  const FieldStyle style = read_style(o->style);
  check_arrows(o->arrows);
  FinishedRun run = open_run(o->series);
  if (!o->label.empty()) run.label = o->label;
  const std::vector<std::size_t> frames = choose_frames(run.series, o->times);
  Spread spread = spread_of(run, frames, selection, *o);
  const ShownUnit unit = shown_unit(selection.name, spread.largest);
  for (ValueRange& e : spread.extents) e = {e.low * unit.factor, e.high * unit.factor};
  ColourScale scale = scale_of(selection, unit, run.scene, read_range("--range", o->range));
  scale.map = read_map(o->map, selection);
  set_range(scale, spread, *o, selection);
  const auto panel_at = [&](std::size_t i) {
    const Frame frame = frame_of(run, i);
    ContourPanel panel =
        panel_of(run, frame, scaled(values_of(frame, selection), unit.factor), o->deformation, style);
    set_titles(panel, run, i, selection, *o);
    add_marks(panel, frame, *o);
    return panel;
  };
  ContourFigure empty{.title = figure_title(run, selection, *o),
                      .panels = {},
                      .scale = scale,
                      .style = style,
                      .include = {},
                      .columns = o->times.size() > 1 ? 0 : 1,
                      .width = o->width,
                      .height = o->height};
  const auto figure_of = [&](std::size_t i) {
    ContourFigure figure = empty;
    figure.panels = {panel_at(i)};
    return figure;
  };
  const auto save = [&](const ContourFigure& figure, std::size_t frame) {
    saved_at(picture_path(*o, run, selection, frame),
             [&](const fs::path& path) { save_contours(figure, path); });
  };
  if (is_film(*o)) {
    const auto moment = [&](std::size_t i) {
      ContourFigure figure = figure_of(frames[i]);
      figure.include = spread.corners;
      return figure;
    };
    saved_at(o->out, [&](const fs::path& path) { save_film(frames.size(), moment, o->rate, path); });
  } else if (o->times.size() > 1) {
    for (const std::size_t i : frames) empty.panels.push_back(panel_at(i));
    save(empty, frames[0]);
  } else {
    for (const std::size_t i : frames) save(figure_of(i), i);
  }
  return Exit::done;
}

}  // namespace porosph::app
