// porosph run: computes a case and keeps its files.
#include <fmt/format.h>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <optional>

#include "app/check_by_fem.hpp"
#include "app/command.hpp"
#include "app/memory.hpp"
#include "app/progress.hpp"
#include "app/results.hpp"
#include "app/shipped_cases.hpp"
#include "app/summarise.hpp"
#include "app/threads.hpp"
#include "app/warnings.hpp"
#include "solver/case/case_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/run_folder/folder_lock.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;

volatile std::sig_atomic_t signal_caught = 0;

/// The first signal ends the run in order, the second at once.
void catch_signal(int signal) {
  if (signal_caught != 0) std::_Exit(Exit::interrupted);
  signal_caught = signal;
}

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
      "resume", "go on from the last checkpoint, if there is one, to the same results")(
      "checkpoint-every", po::value(&o.checkpoint_every)->value_name("SECONDS")->default_value(60),
      "of wall time between checkpoints; an interrupted run leaves one, too")(
      "force", "replace another case's results, or an interrupted run")(
      "no-frames", "write history and summary only")("quiet", "say nothing unless something is wrong");
  po::positional_options_description positional;
  positional.add("case", 1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "run CASE.toml [options]",
             "  porosph run cases/foundation.toml\n"
             "  porosph run cases/foundation.toml --set formulation.motion=proposed --out results/proposed\n"
             "  porosph run cases/foundation.toml --set particles.spacing=0.1 --threads 2 --no-frames\n"
             "  porosph run cases/foundation.toml --resume\n",
             values))
    return std::nullopt;
  o.case_file = find_case(case_file);
  o.folder =
      folder.empty() ? std::filesystem::path("results") / o.case_file.stem() : std::filesystem::path(folder);
  o.frames = values.count("no-frames") == 0;
  o.quiet = values.count("quiet") > 0;
  o.resume = values.count("resume") > 0;
  o.force = values.count("force") > 0;
  if (o.resume && o.force)
    throw UsageError("--resume goes on with a run and --force begins it anew: give one");
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

/// The state from which a run goes on.
struct LeftOff {
  RunProgress progress;
  double wall_seconds = 0;

  void visit(StateArchive& state, Simulation& simulation) {
    simulation.visit(state);
    progress.visit(state);
    state.value("wall_seconds", wall_seconds);
  }
};

std::optional<FoundState> find_sound_state(const std::filesystem::path& folder,
                                           const std::string& case_text) {
  try {
    return find_state(folder, case_text);
  } catch (const ReadError& error) {
    throw ReadError(error, "; --force begins the run anew");
  }
}

/// Puts the simulation where the folder's checkpoint left off; nothing if there is none.
std::optional<LeftOff> restore(const std::filesystem::path& folder, const std::string& case_text,
                               Simulation& simulation) {
  const auto found = find_sound_state(folder, case_text);
  if (!found) return std::nullopt;
  if (!found->note.empty()) std::cerr << "porosph: " << found->note << "; the checkpoint before it is used\n";
  LeftOff left_off;
  try {
    StateReader reader(found->state);
    left_off.visit(reader, simulation);
    reader.finish();
  } catch (const StateError& error) {
    throw ReadError(folder / "checkpoint.bin", error.what());
  }
  return left_off;
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

}  // namespace

int run_command(const Arguments& arguments) {
  const auto options = read_options(arguments);
  if (!options) return Exit::done;
  const auto start = std::chrono::steady_clock::now();
  std::signal(SIGINT, catch_signal);
  std::signal(SIGTERM, catch_signal);
  const Case scene = read_case(options->case_file, options->overrides);
  const std::string case_text = write_case(scene);
  check_memory(scene);
  require_fem(scene);
  const FolderLock lock(options->folder);
  if (!options->force) check_owner(options->folder, case_text, options->resume);
  if (options->resume) {
    if (const auto done = finished_summary(options->folder)) {
      if (!options->quiet) fmt::print("nothing to resume in {}: {}", options->folder.string(), tell(*done));
      return exit_of(done->status);
    }
  }
  std::vector<std::string> warnings = warnings_of(scene);
  warn(warnings);
  Simulation simulation(scene);
  const std::vector<std::string> of_particles = warnings_of(simulation.model(), scene);
  warn(of_particles);
  warnings.insert(warnings.end(), of_particles.begin(), of_particles.end());
  warn_of_smaller_steps(simulation);
  use_threads(options->threads, simulation.model().particles.size());
  const auto left_off =
      options->resume ? restore(options->folder, case_text, simulation) : std::optional<LeftOff>();
  Results results = left_off ? Results(options->folder, simulation, options->frames, left_off->progress)
                             : Results(options->folder, simulation, options->frames);
  if (!options->quiet) {
    fmt::print("{}: {} particles, {} steps to {:g} s, results in {}\n", simulation.scene().title,
               simulation.model().particles.size(), simulation.last_step(), simulation.scene().time.end,
               options->folder.string());
    if (options->resume)
      fmt::print("{}\n", left_off ? fmt::format("goes on from {:.6g} s", simulation.time())
                                  : "there is no checkpoint to go on from: begins at the start");
  }
  std::fflush(stdout);

  const auto wall_seconds = [&] {
    const std::chrono::duration<double> now = std::chrono::steady_clock::now() - start;
    return now.count() + (left_off ? left_off->wall_seconds : 0);
  };
  Progress progress(options->quiet, simulation);
  Interval since_checkpoint(options->checkpoint_every);
  const auto keep = [&](Simulation& s, RunProgress& p, bool ending) {
    if (!ending && !since_checkpoint.over()) return;
    StateWriter state;
    LeftOff{p, wall_seconds()}.visit(state, s);
    results.checkpoint(state.content());
    since_checkpoint.restart();
  };
  const RunOutcome outcome = run(simulation,
                                 {.frame = [&](Simulation& s) { results.frame(s); },
                                  .history = [&](const auto& row) { results.row(row); },
                                  .progress = [&](const Simulation& s) { progress.show(s); },
                                  .interrupted = [] { return signal_caught != 0; },
                                  .checkpoint = keep},
                                 left_off ? left_off->progress : RunProgress{});
  progress.finish();
  Summary summary = summarise(simulation, outcome, wall_seconds());
  summary.finite_elements = check_by_fem(simulation, summary);
  summary.warnings = warnings;
  results.finish(summary);
  if (!options->quiet) std::cout << tell(summary) << std::flush;
  warn_of_differences(summary);
  if (outcome.status == RunStatus::unstable && options->quiet)
    std::cerr << "porosph: unstable: " << outcome.message << '\n';
  return exit_of(outcome.status);
}

}  // namespace porosph::app
