// porosph safety: the factor of safety of a case, by the particles and by limit equilibrium.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "app/command.hpp"
#include "app/interruption.hpp"
#include "app/let_fail.hpp"
#include "app/results.hpp"
#include "app/say.hpp"
#include "app/shipped_cases.hpp"
#include "app/stopwatch.hpp"
#include "app/threads.hpp"
#include "app/warnings.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/stages.hpp"
#include "solver/printable.hpp"
#include "solver/reference/limit_equilibrium/section_of_case.hpp"
#include "solver/water/transient_water.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/folder_lock.hpp"
#include "vtk_io/run_folder/safety_files.hpp"
#ifdef POROSPH_HAS_VTK
#include "vtk_io/line_vtp.hpp"
#endif
#ifdef POROSPH_HAS_RENDER
#include "render/report/safety_study.hpp"
#include "render/run/safety_pictures.hpp"
#endif

namespace porosph::app {
namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::string case_file, folder, method;
  std::vector<std::string> overrides;
  double bracket = 0.01;
  std::optional<double> at;  // s
  int jobs = 1;
  bool quiet = false, force = false;
  std::optional<double> then_run;  // factor; 0: the smallest at which it fails

  bool by_particles() const { return method != "limit-equilibrium"; }
  bool by_limit_equilibrium() const { return method != "strength-reduction"; }
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  double at = 0;
  po::options_description options;
  options.add_options()("case", po::value(&o.case_file)->required(), "the case file")(
      "out", po::value(&o.folder)->value_name("DIR"),
      "folder for the results (default: results/<case>_safety)")(
      "method",
      po::value(&o.method)->value_name("both|strength-reduction|limit-equilibrium")->default_value("both"),
      "strength reduction in the particles, limit equilibrium on slip surfaces, or both")(
      "bracket", po::value(&o.bracket)->value_name("WIDTH")->default_value(0.01, "0.01"),
      "how close to each other the factors shall be at which the body rests and fails")(
      "at", po::value(&at)->value_name("SECONDS"),
      "the time at which seepage over time is taken (default: the end)")(
      "set", po::value(&o.overrides)->value_name("KEY=VALUE"),
      "replaces a setting of the case; may be given again");
  add_jobs(options, o.jobs, "factors tried at a time");
  options.add_options()(
      "then-run", po::value<double>()->value_name("=FACTOR")->implicit_value(0, ""),
      "let it fail with its strength divided by this, or by the smallest factor at which it fails, and "
      "show the runout")("force", "replace another case's results")("quiet",
                                                                    "say nothing unless something is wrong");
  po::positional_options_description positional;
  positional.add("case", 1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "safety CASE.toml [options]",
             "  porosph safety safety/griffiths_lane_1\n"
             "  porosph safety safety/griffiths_lane_1 --method limit-equilibrium\n"
             "  porosph safety safety/griffiths_lane_1 --set \"soil.slope.cohesion=5 kPa\" --out "
             "results/weaker\n",
             values))
    return std::nullopt;
  if (o.method != "both" && o.method != "strength-reduction" && o.method != "limit-equilibrium")
    throw UsageError(fmt::format("--method = {}: must be both, strength-reduction or limit-equilibrium",
                                 printable(o.method)));
  if (!(o.bracket >= 1e-4 && o.bracket <= 1))
    throw UsageError(fmt::format("--bracket = {}: must be from 0.0001 to 1", o.bracket));
  check_jobs(o.jobs);
  if (values.count("at") > 0) o.at = at;
  o.quiet = values.count("quiet") > 0, o.force = values.count("force") > 0;
  if (values.count("then-run") > 0) o.then_run = values["then-run"].as<double>();
  if (o.then_run && !o.by_particles())
    throw UsageError("--then-run needs strength reduction: --method both or strength-reduction");
  return o;
}

void check_soils(const Case& scene) {
  require_plain(scene, "porosph safety");
  if (!scene.loading.gravity_applied)
    throw UsageError(
        "safety: loading.gravity_applied = false: nothing drives the soil, so it has no factor of safety");
  for (const SoilCase& soil : scene.soils)
    if (soil.law != LawKind::elastic) return;
  throw UsageError(
      "safety: no soil of the case has a strength: give one soil[].law = \"mohr_coulomb\", "
      "\"drucker_prager\" or "
      "\"tresca\"");
}

/// Limit equilibrium takes pore pressure from a level; that of flow it does not know.
void check_water(const Case& scene, const Options& o) {
  if (scene.loading.horizontal != 0 && o.by_limit_equilibrium())
    throw UsageError(
        "safety: limit equilibrium knows no horizontal acceleration (loading.horizontal); "
        "--method strength-reduction does");
  const bool transient = scene.water.mode == WaterMode::transient;
  if (o.at && !transient) throw UsageError("--at: is for seepage over time, water.mode = \"transient\"");
  if (o.at && !(*o.at >= 0 && *o.at <= scene.time.end))
    throw UsageError(fmt::format("--at = {}: must be from 0 to time.end = {} s", *o.at, scene.time.end));
  if (!scene.footings.empty() && o.by_limit_equilibrium())
    throw UsageError(
        "safety: limit equilibrium knows no footing ([[footing]]); --method strength-reduction does");
  if (o.then_run && transient)
    throw UsageError("--then-run is not for seepage over time, water.mode = \"transient\"");
  if (!scene.water.flows()) return;
  if (scene.water.couples())
    throw UsageError(
        fmt::format("safety: water.mode = \"{}\" is not possible: the factor of safety is that of soil at "
                    "rest in still or "
                    "steady water; give undrained clay the law \"tresca\" in still water",
                    name(scene.water.mode)));
  if (!o.by_particles())
    throw UsageError(
        fmt::format("safety: limit equilibrium is for still water, but water.mode is \"{}\"; "
                    "--method strength-reduction takes the water that flows",
                    name(scene.water.mode)));
  if (o.by_limit_equilibrium() && !o.quiet)
    say(stdout, "note: limit equilibrium is for still water and is left out\n");
}

/// The flow as it is at that time holds in all trials.
void flow_until(double time, Case& scene, bool quiet) {
  const Model model = build_model(scene);
  auto& water = dynamic_cast<TransientWater&>(*model.pore_water);
  const Stopwatch watch;
  for (double now = 0; now < time && !is_interrupted();) now = water.advance(now, time);
  const auto head = water.richards().head();
  scene.flow = std::make_shared<GivenFlow>(GivenFlow{{head.begin(), head.end()}, time});
  if (!quiet)
    say(stdout, fmt::format("seepage to {:g} s: {} flow steps, {:.2f} s\n", time,
                            water.richards().counts().steps, watch.seconds()));
}

void find_by_limit_equilibrium(const Case& scene, SafetyAnswer& answer) {
  const Stopwatch watch;
  answer.limit_equilibrium = limit_equilibrium::find_critical_surfaces(limit_equilibrium::section_of(scene));
  answer.limit_equilibrium_seconds = watch.seconds();
}

void find_by_particles(const Case& scene, const Options& o, SafetyAnswer& answer) {
  StrengthReductionOptions options{.bracket = o.bracket, .jobs = o.jobs, .interrupted = is_interrupted};
  if (answer.limit_equilibrium) options.first_guess = answer.limit_equilibrium->bishop.factor;
  if (!o.quiet)
    options.finished = [](const StrengthTrial& t) {
      say(stdout, fmt::format("strength / {:<7.4f} {}, {:.4g} m after {} steps\n", t.factor, words_of(t.end),
                              t.displacement, t.steps));
    };
  const Stopwatch watch;
  answer.particles = reduce_strength(scene, options);
  answer.particle_seconds = watch.seconds();
}

void tell(const SafetyAnswer& answer) {
  say(stdout, "\nfactor of safety\n");
  const auto row = [](const std::string& method, const std::string& factor, double seconds) {
    say(stdout, fmt::format("  {:36} {:18} {:.2f} s\n", method, factor, seconds));
  };
  if (answer.particles)
    row("strength reduction, particles", bracket_text(*answer.particles), answer.particle_seconds);
  for (const NamedSurface& s : slip_surfaces(answer))
    row("limit equilibrium, " + s.name, fmt::format("{:.3f}", s.surface.factor),
        answer.limit_equilibrium_seconds);
  if (answer.limit_equilibrium && !answer.limit_equilibrium->spencer)
    say(stdout, "  Spencer's method has no solution: steep soil would hang on its crest in tension\n");
}

void write([[maybe_unused]] const Case& scene, const SafetyAnswer& answer,
           [[maybe_unused]] const std::string& command, const fs::path& folder) {
  if (answer.particles) write_trials(folder / "safety.csv", *answer.particles);
  if (answer.limit_equilibrium) {
    write_slip_surfaces(folder / "slip_surfaces.csv", answer);
#ifdef POROSPH_HAS_VTK
    std::vector<std::vector<Point>> lines;
    std::vector<double> factors;
    for (const NamedSurface& s : slip_surfaces(answer))
      lines.push_back(s.surface.points), factors.push_back(s.surface.factor);
    write_lines_vtp(folder / "slip_surfaces.vtp", lines, "FactorOfSafety", factors);
#endif
  }
#ifdef POROSPH_HAS_RENDER
  if (answer.particles) save_safety_curve(answer, folder / "safety.png");
  save_mechanism(scene, answer, folder / "mechanism.png");
  write_study(safety_study(answer, command), folder);
#endif
  write_safety_summary(folder / "safety.json", answer);
}

}  // namespace

int safety_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  Case scene = read_case(find_case(o->case_file), o->overrides);
  check_soils(scene);
  check_water(scene, *o);
  const fs::path folder = o->folder.empty()
                              ? fs::path("results") / (fs::path(o->case_file).stem().string() + "_safety")
                              : fs::path(o->folder);
  catch_interruptions();
  const std::string case_text = write_case(scene);
  const bool over_time = scene.water.mode == WaterMode::transient;
  const FolderLock lock(folder);
  if (!o->force) check_owner(folder, case_text, true);
  SafetyAnswer answer;
  answer.title = scene.title;
  answer.warnings = warnings_of(scene);
  warn(answer.warnings);
  if (over_time) flow_until(o->at.value_or(scene.time.end), scene, o->quiet);
  if (is_interrupted()) return Exit::interrupted;
  if (!scene.water.flows()) find_by_limit_equilibrium(scene, answer);
  if (!answer.limit_equilibrium && !o->by_particles())
    throw UsageError("safety: nothing can slide: the ground is level wherever soil has a strength");
  if (o->by_particles()) find_by_particles(scene, *o, answer);
  if (is_interrupted()) return Exit::interrupted;
  if (!o->by_limit_equilibrium()) answer.limit_equilibrium.reset();
  const std::string apart = disagreement(answer);
  if (!apart.empty()) answer.warnings.push_back(apart);
  take_folder(folder, case_text);
  write(scene, answer, command_line("safety", arguments), folder);
  if (!o->quiet) {
    tell(answer);
    say(stdout, folder.string() + "\n");
  }
  if (!apart.empty()) warn({apart});
  return o->then_run ? let_fail(scene, *answer.particles, *o->then_run, folder, o->quiet) : Exit::done;
}

}  // namespace porosph::app
