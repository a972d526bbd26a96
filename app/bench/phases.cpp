#include "app/bench/phases.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/bench/csv.hpp"
#include "app/bench/timed_dynamics.hpp"
#include "render/chart.hpp"
#include "solver/output/fields.hpp"
#include "solver/run/run.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"
#include "vtk_io/particle_series.hpp"

namespace porosph::bench {

using namespace render;

namespace {

struct Form {
  std::string name, motion;
  bool plain;
};

const std::vector<Form> forms = {
    {"plain loops", "proposed", true}, {"consistent", "consistent", false}, {"proposed", "proposed", false}};

/// The phases of one step in the order of the page, by what is timed from outside.
const std::vector<std::string> every_step = {"geometry", "accelerations", "strain", "integration"};
const std::vector<std::string> now_and_then = {"neighbour search", "geometry rebuilt", "monitoring",
                                               "frame written"};

class Subject {
 public:
  Subject(const Bench& bench, const Form& form, int k) {
    const Case scene =
        read(bench, "foundation.toml",
             {"formulation.motion=" + form.motion, fmt::format("particles.spacing={:.17g}", 5.0 / k)});
    const auto timed_one = [&](const FormulationCase& f, Model& model) -> std::unique_ptr<Dynamics> {
      auto inner = form.plain ? make_plain_dynamics(f, model) : make_dynamics(f, model);
      return std::make_unique<TimedDynamics>(std::move(inner), calls_);
    };
    simulation_ = std::make_unique<Simulation>(scene, timed_one);
    simulation_->advance();
    first_geometry_ = calls_.prepare.cpu;
    step_seconds_ = timed([&] { simulation_->advance(); }).cpu;
    simulation_->accelerations();  // as measure() leaves it
  }

  double particles() const { return static_cast<double>(simulation_->model().particles.size()); }

  /// Nanoseconds per particle and step, or per particle and event, by phase.
  void measure(double seconds, const std::filesystem::path& folder,
               std::map<std::string, std::vector<double>>& into) {
    const auto steps = std::max<std::int64_t>(1, std::llround(seconds / step_seconds_));
    const CallTimes before = calls_;
    const double all = timed([&] {
                         for (std::int64_t i = 0; i < steps; ++i) simulation_->advance();
                         simulation_->accelerations();  // the next step's, which watching needs as well
                       }).cpu;
    const double per_step = 1e9 / particles() / static_cast<double>(steps), once = 1e9 / particles();
    const auto spent = [&](Seconds CallTimes::*call) { return (calls_.*call - before.*call).cpu; };
    into["geometry"].push_back(per_step * spent(&CallTimes::prepare));
    into["accelerations"].push_back(per_step * spent(&CallTimes::accelerations));
    into["strain"].push_back(per_step * spent(&CallTimes::strain));
    into["integration"].push_back(per_step * (all - (calls_.total() - before.total()).cpu));

    const auto& position = simulation_->model().particles.position;
    const double reach = 2 * simulation_->model().smoothing_length;
    into["neighbour search"].push_back(once *
                                       timed([&] { find_neighbours(position, position.size(), reach); }).cpu);
    into["geometry rebuilt"].push_back(once * first_geometry_);
    into["monitoring"].push_back(once * timed([&] {
                                          simulation_->look_for_breakdown();
                                          simulation_->unbalanced_force_ratio();
                                        }).cpu);
    into["frame written"].push_back(
        once * timed([&] {
                 SeriesWriter(folder).write(make_frame(*simulation_, simulation_->scene().output.fields));
               }).cpu);
  }

 private:
  CallTimes calls_;
  std::unique_ptr<Simulation> simulation_;
  double step_seconds_ = 0, first_geometry_ = 0;
};

std::vector<int> sizes(const Bench& bench) {
  std::vector<int> all = bench.options().quick ? std::vector{13, 25, 41} : std::vector{13, 25, 41, 129};
  std::erase_if(all, [&](int k) { return 6LL * k * k > bench.options().particles; });
  return all;
}

/// Frames are written here and thrown away.
struct Scratch {
  std::filesystem::path folder;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
};

}  // namespace

Phases measure_phases(Bench& bench) {
  omp_set_num_threads(1);
  Phases phases;
  const int rounds = bench.options().quick ? 3 : 5;
  const double slice = bench.options().quick ? 0.05 : 0.15;
  const Scratch scratch{bench.options().out / "phases_frames"};
  for (int k : sizes(bench)) {
    bench.tell(fmt::format("phases at {} particles", 6 * k * k));
    std::vector<std::unique_ptr<Subject>> subjects;
    for (const Form& form : forms) subjects.push_back(std::make_unique<Subject>(bench, form, k));
    std::vector<std::map<std::string, std::vector<double>>> found(forms.size());
    for (int round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < forms.size(); ++i) subjects[i]->measure(slice, scratch.folder, found[i]);
    for (std::size_t i = 0; i < forms.size(); ++i)
      for (const auto* group : {&every_step, &now_and_then})
        for (const std::string& phase : *group)
          phases.costs.push_back({.form = forms[i].name,
                                  .particles = static_cast<std::int64_t>(subjects[i]->particles()),
                                  .phase = phase,
                                  .nanoseconds = spread_of(found[i][phase])});
  }
  return phases;
}

namespace {

using Rows = std::vector<std::vector<std::string>>;

void write_table(const Phases& phases, const Bench& bench) {
  Rows rows = {{"form", "particles", "phase", "nanoseconds_per_particle", "low", "high"}};
  for (const PhaseCost& c : phases.costs)
    rows.push_back({c.form, std::to_string(c.particles), c.phase, digits(c.nanoseconds.median),
                    digits(c.nanoseconds.low), digits(c.nanoseconds.high)});
  write_csv(bench.options().out / "phases.csv", rows);
}

void draw(const Phases& phases, const Bench& bench) {
  static constexpr Marker markers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  ChartFigure figure{.title = "", .charts = {}, .columns = 1, .width = 1100, .height = 1080};
  double highest = 10;
  for (const PhaseCost& c : phases.costs) highest = std::max(highest, c.nanoseconds.median);
  for (const Form& form : forms) {
    Chart chart{.title = form.name,
                .x = {.title = "particles", .logarithmic = true},
                .y = {.title = "ns per particle", .logarithmic = true, .range = {{1, 2 * highest}}},
                .series = {},
                .references = {}};
    std::size_t i = 0;
    for (const auto* group : {&every_step, &now_and_then})
      for (const std::string& phase : *group) {
        ChartSeries series{.label = phase, .x = {}, .y = {}};
        series.marker = markers[i++ % 4];
        if (group == &now_and_then) series.line = LineStyle::dotted;
        for (const PhaseCost& c : phases.costs)
          if (c.form == form.name && c.phase == phase)
            series.x.push_back(static_cast<double>(c.particles)), series.y.push_back(c.nanoseconds.median);
        chart.series.push_back(series);
      }
    figure.charts.push_back(chart);
  }
  save_charts(figure, bench.options().out / "phases.png");
}

Rows cost_table(const Phases& phases) {
  Rows rows = {{"Form", "Particles"}};
  for (const auto* group : {&every_step, &now_and_then})
    rows[0].insert(rows[0].end(), group->begin(), group->end());
  for (const PhaseCost& c : phases.costs) {
    if (rows.back()[0] != c.form || rows.back()[1] != std::to_string(c.particles))
      rows.push_back({c.form, std::to_string(c.particles)});
    rows.back().push_back(fmt::format("{:.1f}", c.nanoseconds.median));
  }
  return rows;
}

}  // namespace

StudySection show_phases(const Phases& phases, const Bench& bench) {
  write_table(phases, bench);
  draw(phases, bench);
  return {.heading = "Where the time goes",
          .paragraphs =
              {"Nanoseconds of one core per particle, medians of several rounds, timed at the calls "
               "between the integrator and the motion equation. Geometry: what is done in a step to bring "
               "ghosts, neighbours and kernel gradients up to date, where that is due. Accelerations "
               "include the images behind walls, integration all that is left of a step. Dotted: what one "
               "neighbour search, one making of all lists and kernel gradients, one look at equilibrium "
               "and separation, and one written frame cost; they are not part of every step."},
          .tables = {{.caption = "", .rows = cost_table(phases)}},
          .pictures = {{.file = "phases.png",
                        .description = "Cost of the phases of a step over the number of particles",
                        .caption = "Cost per particle of each phase"}}};
}

}  // namespace porosph::bench
