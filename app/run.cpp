// porosph run: computes a case and keeps its files.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <optional>

#include "app/check_by_fem.hpp"
#include "app/command.hpp"
#include "app/earlier_run.hpp"
#include "app/interruption.hpp"
#include "app/left_off.hpp"
#include "app/memory.hpp"
#include "app/progress.hpp"
#include "app/results.hpp"
#include "app/say.hpp"
#include "app/shipped_cases.hpp"
#include "app/stage_safety.hpp"
#include "app/summarise.hpp"
#include "app/threads.hpp"
#include "app/warnings.hpp"
#include "solver/case/case_file.hpp"
#include "solver/printable.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/run_folder/folder_lock.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;

struct Options {
  std::filesystem::path case_file, folder;
  std::vector<std::string> overrides;
  int threads = 0;
  double checkpoint_every = 60;  // s of wall time
  bool frames = true, quiet = false, resume = false, force = false;
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  std::string case_file, folder;
  po::options_description options;
  options.add_options()("case", po::value(&case_file)->required(), "the case file")(
      "out", po::value(&folder)->value_name("DIR"), "folder for the results (default: results/<case>)")(
      "set", po::value(&o.overrides)->value_name("KEY=VALUE"),
      "replaces a setting of the case; may be given again, e.g. formulation.motion=proposed")(
      "threads", po::value(&o.threads)->value_name("N"),
      "threads to compute with (default: the cores that the particles keep busy)")(
      "resume",
      "continue from the last checkpoint, if there is one, to the same results; --set time.end=T with a "
      "later T "
      "also continues a run that is complete")(
      "checkpoint-every", po::value(&o.checkpoint_every)->value_name("SECONDS")->default_value(60),
      "of wall time between checkpoints; an interrupted run leaves one, too")(
      "force", "replace another case's results, or an interrupted run")(
      "no-frames", "write history and summary only")("quiet", "say nothing unless something is wrong");
  po::positional_options_description positional;
  positional.add("case", 1);
  po::variables_map values;
  if (!parse(
          arguments, options, positional, "run CASE.toml [options]",
          "  porosph run cases/foundation.toml\n"
          "  porosph run cases/foundation.toml --set formulation.motion=proposed --out results/proposed\n"
          "  porosph run cases/foundation.toml --set particles.spacing=0.1 --no-frames --out results/fine\n"
          "  porosph run cases/foundation.toml --resume\n"
          "  porosph run cases/foundation.toml --resume --set time.end=8\n",
          values))
    return std::nullopt;
  o.case_file = find_case(case_file);
  o.folder =
      folder.empty() ? std::filesystem::path("results") / o.case_file.stem() : std::filesystem::path(folder);
  o.frames = values.count("no-frames") == 0;
  o.quiet = values.count("quiet") > 0;
  o.resume = values.count("resume") > 0;
  o.force = values.count("force") > 0;
  if (o.resume && o.force) throw UsageError("--resume continues a run and --force starts it again: give one");
  if (!(o.checkpoint_every > 0))
    throw UsageError(fmt::format("--checkpoint-every = {}: must be > 0 s", o.checkpoint_every));
  if (values.count("threads") > 0 && (o.threads < 1 || o.threads > 1024))
    throw UsageError(fmt::format("--threads = {}: must be from 1 to 1024", o.threads));
#ifndef POROSPH_HAS_VTK
  if (o.frames && !o.quiet)
    std::cerr << "built without VTK: history and summary are written, frames are not\n";
  o.frames = false;
#endif
  return o;
}

int exit_of(RunStatus status) {
  if (status == RunStatus::unstable) return Exit::unstable;
  return status == RunStatus::interrupted ? Exit::interrupted : Exit::done;
}

std::optional<FoundState> find_sound_state(const std::filesystem::path& folder,
                                           const std::string& case_text) {
  try {
    return find_state(folder, case_text);
  } catch (const ReadError& error) {
    throw ReadError(error, "; --force starts the run again");
  }
}

/// The case that is computed, and how it relates to the run in its folder.
struct Task {
  Case scene;
  std::string case_text;
  std::optional<std::string> earlier;  ///< text of the case with an earlier end that --resume continues

  const std::string& text_in_folder() const { return earlier ? *earlier : case_text; }
};

Task read_task(const Options& o) {
  Task task{read_case(o.case_file, o.overrides), "", std::nullopt};
  if (o.resume) task.earlier = adopt_earlier_run(o.folder, task.scene);
  task.case_text = write_case(task.scene);
  return task;
}

/// How the folder's run ended, if --resume has nothing to continue.
std::optional<Summary> nothing_to_resume(const Options& o, const Task& task) {
  const auto done = o.resume ? finished_summary(o.folder) : std::nullopt;
  if (!done || !task.earlier || done->status != RunStatus::completed) return done;
  if (!has_checkpoint(o.folder))
    throw UsageError(
        fmt::format("{} does not hold the state at the end of its run (checkpoint.bin): --force "
                    "computes the case from the start",
                    o.folder.string()));
  return std::nullopt;
}

/// Puts the simulation where the folder's checkpoint left off; nothing if there is none.
std::optional<LeftOff> restore(const std::filesystem::path& folder, const Task& task, StagedRun& run) {
  const auto found = find_sound_state(folder, task.text_in_folder());
  if (!found) return std::nullopt;
  if (!found->note.empty())
    std::cerr << "porosph: " << printable(found->note) << "; the checkpoint before it is used\n";
  LeftOff left_off;
  try {
    StateReader reader(found->state);
    left_off.visit(reader, run);
    reader.finish();
  } catch (const StateError& error) {
    throw ReadError(folder / "checkpoint.bin", error.what());
  }
  return left_off;
}

/// The folder's files, continued or new.
/// Of the run as it is when they are asked for.
StateBytes state_bytes(LeftOff left_off, StagedRun& stages) {
  return [left_off, &stages](const ByteSink& sink) mutable {
    StatePourer state(sink);
    left_off.visit(state, stages);
  };
}

Results open_results(const Options& o, const Case& scene, const Simulation& simulation,
                     const std::optional<LeftOff>& left_off) {
  if (!left_off) return {o.folder, scene, simulation, o.frames};
  try {
    return {o.folder, scene, simulation, o.frames, left_off->progress, left_off->written};
  } catch (const ReadError& error) {
    throw ReadError(error, ": the run cannot be resumed; --force starts it again");
  }
}

/// The state that the case names to start from, unless there is a checkpoint to continue from.
std::optional<HandedOver> state_to_start_from(const Options& o, const Task& task) {
  if (task.scene.start_from.empty() || (o.resume && has_checkpoint(o.folder))) return std::nullopt;
  return last_state(task.scene.start_from);
}

void tell_beginning(const Options& o, const StagedRun& run, bool continues) {
  const Simulation& s = run.simulation();
  const std::string steps = s.follows_flow() ? "flow steps" : fmt::format("{} steps", s.last_step());
  say(stdout, fmt::format("{}: {} particles, {} to {:g} s, results in {}\n", s.scene().title,
                          s.model().particles.size(), steps, s.scene().time.end, o.folder.string()));
  if (o.resume)
    say(stdout, continues ? fmt::format("continues from {:.6g} s\n", s.time())
                          : "there is no checkpoint to continue from: starts at the beginning\n");
}

void tell_stage(const StagedRun& run) {
  const Simulation& s = run.simulation();
  say(stdout, fmt::format("stage '{}' from {:.6g} s: {}; {} particles, at most {} steps\n", run.plan().name(),
                          s.start_time(), fmt::join(run.plan().changes(), "; "), s.model().particles.size(),
                          s.last_step()));
}

/// Says when a checkpoint is due.
class Interval {
 public:
  explicit Interval(double seconds) : seconds_(seconds) {}
  bool over() const { return std::chrono::duration<double>(Clock::now() - start_).count() >= seconds_; }
  void restart() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  double seconds_;
  Clock::time_point start_ = Clock::now();
};

/// What a run writes as it goes, and how long it has taken.
class Recorder {
 public:
  using Clock = std::chrono::steady_clock;
  Recorder(Results& results, StagedRun& stages, double checkpoint_every, Clock::time_point start,
           double seconds_before)
      : results_(results),
        stages_(stages),
        since_checkpoint_(checkpoint_every),
        start_(start),
        seconds_before_(seconds_before) {}

  /// Since the run began, with what came before a resumption [s].
  double wall_seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count() + seconds_before_;
  }
  StateBytes state(const RunProgress& progress) const {
    return state_bytes({progress, results_.written(), wall_seconds()}, stages_);
  }
  RunWatch watch(Progress& progress) {
    return {.frame = [&](Simulation& s) { results_.frame(s); },
            .history = [&](const auto& row) { results_.row(row); },
            .progress = [&](const Simulation& s) { progress.show(s); },
            .interrupted = is_interrupted,
            .checkpoint = [&](Simulation& s, RunProgress& p, bool ending) { keep(s, p, ending); }};
  }

 private:
  void keep(const Simulation& s, const RunProgress& progress, bool ending) {
    if (!ending && !since_checkpoint_.over()) return;
    try {
      results_.checkpoint(state(progress));
    } catch (const WriteError& error) {
      if (s.step() < s.last_step()) throw;  // a run that is complete has its results without it
      std::cerr << fmt::format("porosph: warning: {}; the run cannot be resumed to a later end\n",
                               error.what());
    }
    since_checkpoint_.restart();
  }

  Results& results_;
  StagedRun& stages_;
  Interval since_checkpoint_;
  Clock::time_point start_;
  double seconds_before_;
};

/// Carries the run through its stages; `so_far` is where the last one got.
RunOutcome run_stages(StagedRun& stages, Recorder& recorder, const Options& options, RunProgress& so_far) {
  const bool quiet = options.quiet;
  while (true) {
    Progress progress(quiet, stages.simulation());
    RunOutcome outcome = run(stages.simulation(), recorder.watch(progress), so_far);
    progress.finish();
    if (outcome.status == RunStatus::interrupted) return outcome;
    std::optional<Summary::Safety> safety;
    if (stages.asks_for_safety() && !outcome.failed && outcome.status != RunStatus::unstable)
      safety = find_stage_safety(stages, options.folder, quiet);
    if (is_interrupted()) {  // the last checkpoint is in this stage, from where its end is found again
      outcome.status = RunStatus::interrupted, outcome.message = "stopped by request";
      return outcome;
    }
    stages.end(outcome, std::move(safety));
    if (!stages.goes_on()) return outcome;
    stages.go_on();
    so_far = {.stepping_seconds = outcome.stepping_seconds};
    if (!quiet) tell_stage(stages);
  }
}

/// Says what is doubtful, and returns it.
std::vector<std::string> doubts(const Case& scene, StagedRun& stages) {
  std::vector<std::string> warnings = warnings_of(stages.simulation().model(), stages.simulation().scene());
  warn(warnings);
  warn_of_smaller_steps(stages.simulation());
  const std::vector<std::string> of_case = warnings_of(scene);
  warnings.insert(warnings.begin(), of_case.begin(), of_case.end());
  return warnings;
}

/// Before the folder is locked: what cannot be computed at all.
void check_possible(const Options& options) {
  const Case scene = read_case(options.case_file, options.overrides);
  check_memory(scene);
  require_fem(scene);
}

}  // namespace

int run_command(const Arguments& arguments) {
  const auto options = read_options(arguments);
  if (!options) return Exit::done;
  const auto start = Recorder::Clock::now();
  catch_interruptions();
  check_possible(*options);
  const FolderLock lock(options->folder);
  const Task task = read_task(*options);
  if (!options->force) check_owner(options->folder, task.text_in_folder(), options->resume);
  if (const auto done = nothing_to_resume(*options, task)) {
    if (!options->quiet)
      say(stdout, fmt::format("nothing to resume in {}: {}", options->folder.string(), tell(*done)));
    return exit_of(done->status);
  }
  warn(warnings_of(task.scene));
  const auto start_state = state_to_start_from(*options, task);
  StagedRun stages(task.scene, start_state ? &*start_state : nullptr);
  const std::vector<std::string> warnings = doubts(task.scene, stages);
  use_threads(options->threads, stages.simulation().model().particles.size());
  const auto left_off = options->resume ? restore(options->folder, task, stages) : std::optional<LeftOff>();
  Results results = open_results(*options, task.scene, stages.simulation(), left_off);
  if (left_off && task.earlier) extend_run(options->folder, task.case_text, state_bytes(*left_off, stages));
  if (!options->quiet) tell_beginning(*options, stages, left_off.has_value());

  Recorder recorder(results, stages, options->checkpoint_every, start, left_off ? left_off->wall_seconds : 0);
  RunProgress so_far = left_off ? left_off->progress : RunProgress{};
  const RunOutcome outcome = run_stages(stages, recorder, *options, so_far);
  Summary summary = summarise(stages, outcome, recorder.wall_seconds());
  summary.finite_elements = check_by_fem(stages.simulation(), summary);
  summary.warnings = warnings;
  const std::vector<std::string> of_end = warnings_of_end(stages.simulation());
  summary.warnings.insert(summary.warnings.end(), of_end.begin(), of_end.end());
  results.finish(summary, recorder.state(so_far));
  if (!options->quiet) say(stdout, tell(summary));
  warn(of_end);
  warn_of_differences(summary);
  if (outcome.status == RunStatus::unstable && options->quiet)
    std::cerr << "porosph: unstable: " << outcome.message << '\n';
  return exit_of(outcome.status);
}

}  // namespace porosph::app
