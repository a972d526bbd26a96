// porosph safety: the factor of safety of a case, by the particles and by limit equilibrium.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "app/command.hpp"
#include "app/find_safety.hpp"
#include "app/interruption.hpp"
#include "app/left_off.hpp"
#include "app/let_fail.hpp"
#include "app/progress.hpp"
#include "app/results.hpp"
#include "app/say.hpp"
#include "app/shipped_cases.hpp"
#include "app/stopwatch.hpp"
#include "app/threads.hpp"
#include "app/warnings.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/case_keys.hpp"
#include "solver/case/safety_obstacle.hpp"
#include "solver/model/model.hpp"
#include "solver/printable.hpp"
#include "solver/sweep/sweep.hpp"
#include "solver/water/transient_water.hpp"
#include "vtk_io/run_folder/folder_lock.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::string case_file, folder, method;
  std::vector<std::string> overrides;
  std::optional<SweepAxis> vary;
  double bracket = 0.01;
  std::optional<double> at;  // s
  int jobs = trials_at_a_time;
  bool quiet = false, force = false;
  std::optional<double> then_run;  // factor; 0: the smallest at which it fails

  bool by_particles() const { return method != "limit-equilibrium"; }
  bool by_limit_equilibrium() const { return method != "strength-reduction"; }
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  double at = 0;
  std::string vary;
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
      "replaces a setting of the case; may be given again")(
      "vary", po::value(&vary)->value_name("KEY=V1,V2,..."),
      "the factor with each of these values of a setting, as a curve");
  add_jobs(options, o.jobs, "factors tried at a time", trials_at_a_time);
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
  if (values.count("vary") > 0) o.vary = parse_axis(vary);
  if (o.vary && o.then_run) throw UsageError("--then-run is for one factor, not for a curve (--vary)");
  if (o.then_run && !o.by_particles())
    throw UsageError("--then-run needs strength reduction: --method both or strength-reduction");
  return o;
}

/// What has no answer, or none by the method that was asked for. `scene`: of the last stage.
void check_possible(const Case& scene, const Options& o) {
  if (const std::string obstacle = safety_obstacle(scene); !obstacle.empty())
    throw UsageError("safety: " + obstacle);
  const bool transient = scene.water.mode == WaterMode::transient;
  if (o.at && !transient) throw UsageError("--at: is for seepage over time, water.mode = \"transient\"");
  if (o.at && !(*o.at >= 0 && *o.at <= scene.time.end))
    throw UsageError(fmt::format("--at = {}: must be from 0 to time.end = {} s", *o.at, scene.time.end));
  if (o.then_run && transient)
    throw UsageError("--then-run is not for seepage over time, water.mode = \"transient\"");
  const std::string obstacle = limit_equilibrium_obstacle(scene);
  if (obstacle.empty() || !o.by_limit_equilibrium()) return;
  if (!scene.water.flows() || !o.by_particles())
    throw UsageError(fmt::format("safety: limit equilibrium {}; --method strength-reduction does", obstacle));
  if (!o.quiet) say(stdout, "note: limit equilibrium is for still water and is left out\n");
}

/// The body whose factor is asked for, and the state that it is in.
struct Body {
  Case scene;
  std::optional<HandedOver> state;  ///< none: as drawn
};

/// The last stage of a case, as those before leave the soil. Throws std::runtime_error where one of them
/// fails by itself.
Body after_all_stages(const Case& scene, const HandedOver* from, bool quiet) {
  StagedRun stages(scene, from);
  use_threads(0, stages.simulation().model().particles.size());
  while (true) {
    Progress progress(quiet, stages.simulation());
    const RunOutcome outcome = run(stages.simulation(), {.frame = {},
                                                         .history = {},
                                                         .progress = [&](const auto& s) { progress.show(s); },
                                                         .interrupted = is_interrupted});
    progress.finish();
    if (outcome.status == RunStatus::interrupted) return {};
    stages.end(outcome);
    const Summary::Stage& ended = stages.ended().back();
    if (ended.ended == "failure" || ended.ended == "unstable")
      throw std::runtime_error(
          fmt::format("safety: stage '{}' fails with the soil's full strength, at {:g} s: {}", ended.name,
                      ended.time, outcome.message));
    if (!quiet)
      say(stdout, fmt::format("stage '{}' ended at {:.6g} s, by {}\n", ended.name, ended.time, ended.ended));
    if (!stages.goes_on()) break;
    stages.go_on();
  }
  Body last{stages.plan().scene(), stages.simulation().hand_over()};
  last.scene.time.end = stages.simulation().time();
  return last;
}

Body body_of(const Case& scene, bool quiet) {
  std::optional<HandedOver> from;
  if (!scene.start_from.empty()) from = last_state(scene.start_from);
  if (scene.stages.empty()) return {scene, std::move(from)};
  return after_all_stages(scene, from ? &*from : nullptr, quiet);
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

/// Of the last stage; the body is that stage's. An interruption leaves it without an answer.
SafetyAnswer find_safety_of(const Case& scene, const Options& o, Body& body) {
  body = body_of(scene, o.quiet);
  if (body.scene.water.mode == WaterMode::transient)
    flow_until(o.at.value_or(scene.time.end), body.scene, o.quiet);
  if (is_interrupted()) return {};
  SafetyAnswer answer = find_safety(body.scene, {.by_particles = o.by_particles(),
                                                 .by_limit_equilibrium = o.by_limit_equilibrium(),
                                                 .bracket = o.bracket,
                                                 .jobs = o.jobs,
                                                 .from = body.state ? &*body.state : nullptr,
                                                 .quiet = o.quiet});
  if (!answer.limit_equilibrium && !o.by_particles())
    throw UsageError("safety: nothing can slide: the ground is level wherever soil has a strength");
  return answer;
}

/// The values of --vary. Throws UsageError where one is not a number.
std::vector<double> numbers_of(const SweepAxis& axis) {
  std::vector<double> numbers;
  for (const SweepValue& value : axis.values) {
    char* end = nullptr;
    numbers.push_back(std::strtod(value.label.c_str(), &end));
    if (*end != 0 || !std::isfinite(numbers.back()))
      throw UsageError(
          fmt::format("--vary {}: {} is not a number", printable(axis.title), printable(value.label)));
  }
  return numbers;
}

/// The factor over a setting.
int follow_setting(const Case& scene, const fs::path& case_file, const Options& o, const fs::path& folder) {
  const std::string& key = o.vary->title;
  SafetyCurve curve{scene.title, key, unit_of_key(key), numbers_of(*o.vary), {}};
  for (const SweepValue& value : o.vary->values) {
    std::vector<std::string> settings = o.overrides;
    settings.insert(settings.end(), value.settings.begin(), value.settings.end());
    const Case with_value = read_case(case_file, settings);
    check_possible(last_stage(with_value), o);
    warn(warnings_of(with_value));
    Body body;
    SafetyAnswer answer = find_safety_of(with_value, o, body);
    if (is_interrupted()) return Exit::interrupted;
    if (!o.quiet) say(stdout, fmt::format("{}\n{}", value.settings.front(), tell(answer)));
    warn(answer.warnings);
    if (answer.particles) answer.particles->mechanism.reset();
    curve.answers.push_back(std::move(answer));
  }
  take_folder(folder, write_case(scene));
  write_curve(curve, folder);
  if (!o.quiet) say(stdout, folder.string() + "\n");
  return Exit::done;
}

}  // namespace

int safety_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  const fs::path case_file = find_case(o->case_file);
  const Case scene = read_case(case_file, o->overrides);
  if (!o->vary) check_possible(last_stage(scene), *o);
  if (o->then_run && !scene.stages.empty())
    throw UsageError(
        "--then-run is for a case without stages: a [[stage]] that sets the soils' strength lets it fail");
  const fs::path folder = o->folder.empty()
                              ? fs::path("results") / (fs::path(o->case_file).stem().string() + "_safety")
                              : fs::path(o->folder);
  catch_interruptions();
  const std::string case_text = write_case(scene);
  const FolderLock lock(folder);
  if (!o->force) check_owner(folder, case_text, true);
  if (o->vary) return follow_setting(scene, case_file, *o, folder);
  const std::vector<std::string> warnings = warnings_of(scene);
  warn(warnings);
  Body body;
  SafetyAnswer answer = find_safety_of(scene, *o, body);
  if (is_interrupted()) return Exit::interrupted;
  const std::vector<std::string> doubts = answer.warnings;
  answer.warnings.insert(answer.warnings.begin(), warnings.begin(), warnings.end());
  take_folder(folder, case_text);
  write_safety(body.scene, answer, command_line("safety", arguments), folder);
  if (!o->quiet) say(stdout, "\nfactor of safety\n" + tell(answer) + folder.string() + "\n");
  warn(doubts);
  return o->then_run ? let_fail(scene, *answer.particles, *o->then_run, folder, o->quiet) : Exit::done;
}

}  // namespace porosph::app
