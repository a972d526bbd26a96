// porosph run: computes a case and keeps its files.
#include <fmt/format.h>
#include <omp.h>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <optional>

#include "app/command.hpp"
#include "app/progress.hpp"
#include "app/shipped_cases.hpp"
#include "app/summarise.hpp"
#include "solver/case/case_file.hpp"
#include "solver/output/boundary_frame.hpp"
#include "solver/output/fields.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/history_csv.hpp"
#include "vtk_io/run_folder/summary_json.hpp"
#ifdef POROSPH_HAS_VTK
#include "vtk_io/particle_series.hpp"
#endif

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
  bool frames = true, quiet = false;
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
      "no-frames", "write history and summary only")("quiet", "say nothing unless something is wrong");
  po::positional_options_description positional;
  positional.add("case", 1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "run CASE.toml [options]",
             "  porosph run cases/foundation.toml\n"
             "  porosph run cases/foundation.toml --set formulation.motion=proposed --out results/proposed\n"
             "  porosph run cases/foundation.toml --set particles.spacing=0.1 --threads 2 --no-frames\n",
             values))
    return std::nullopt;
  o.case_file = find_case(case_file);
  o.folder =
      folder.empty() ? std::filesystem::path("results") / o.case_file.stem() : std::filesystem::path(folder);
  o.frames = values.count("no-frames") == 0;
  o.quiet = values.count("quiet") > 0;
  if (values.count("threads") > 0 && (o.threads < 1 || o.threads > 1024))
    throw UsageError(fmt::format("--threads = {}: must be from 1 to 1024", o.threads));
#ifndef POROSPH_HAS_VTK
  if (o.frames && !o.quiet)
    std::cerr << "built without VTK: history and summary are written, frames are not\n";
  o.frames = false;
#endif
  return o;
}

/// The folder's files, fed by the run.
class Results {
 public:
  Results(const Options& options, const Simulation& simulation)
      : folder_(options.folder), history_(prepared(options.folder, simulation), history_columns(simulation)) {
#ifdef POROSPH_HAS_VTK
    const OutputCase& output = simulation.scene().output;
    if (options.frames)
      series_.emplace(folder_,
                      SeriesOptions{output.format, output.compression, script_scene(simulation.scene())});
#endif
  }

  void frame([[maybe_unused]] Simulation& s) {
#ifdef POROSPH_HAS_VTK
    if (!series_) return;
    const OutputCase& output = s.scene().output;
    series_->write(make_frame(s, output.fields),
                   output.boundary ? std::optional(make_boundary_frame(s)) : std::nullopt);
#endif
  }
  void row(const std::vector<double>& values) { history_.append(values); }
  void finish(const Summary& summary) {
    history_.flush();
    write_summary(folder_ / "summary.json", summary);
  }

 private:
  static std::filesystem::path prepared(const std::filesystem::path& folder, const Simulation& s) {
    make_folder(folder);
    write_file(folder / "case.toml", write_case(s.scene()));
    return folder / "history.csv";
  }

  std::filesystem::path folder_;
  HistoryWriter history_;
#ifdef POROSPH_HAS_VTK
  std::optional<SeriesWriter> series_;
#endif
};

/// More threads than this would wait for each other.
int useful_threads(std::size_t particles) {
  constexpr std::size_t particles_per_thread = 4000;
  return std::clamp(static_cast<int>(particles / particles_per_thread), 1, omp_get_num_procs());
}

int exit_of(RunStatus status) {
  if (status == RunStatus::unstable) return Exit::unstable;
  return status == RunStatus::interrupted ? Exit::interrupted : Exit::done;
}

}  // namespace

int run_command(const Arguments& arguments) {
  const auto options = read_options(arguments);
  if (!options) return Exit::done;
  const auto start = std::chrono::steady_clock::now();
  Simulation simulation(read_case(options->case_file, options->overrides));
  omp_set_num_threads(options->threads > 0 ? options->threads
                                           : useful_threads(simulation.model().particles.size()));
  Results results(*options, simulation);
  if (!options->quiet)
    fmt::print("{}: {} particles, {} steps to {:g} s, results in {}\n", simulation.scene().title,
               simulation.model().particles.size(), simulation.last_step(), simulation.scene().time.end,
               options->folder.string());
  std::fflush(stdout);

  std::signal(SIGINT, catch_signal);
  std::signal(SIGTERM, catch_signal);
  Progress progress(options->quiet);
  const RunOutcome outcome = run(simulation, {.frame = [&](Simulation& s) { results.frame(s); },
                                              .history = [&](const auto& row) { results.row(row); },
                                              .progress = [&](const Simulation& s) { progress.show(s); },
                                              .interrupted = [] { return signal_caught != 0; }});
  progress.finish();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  const Summary summary = summarise(simulation, outcome, wall.count());
  results.finish(summary);
  if (!options->quiet) std::cout << tell(summary);
  if (outcome.status == RunStatus::unstable && options->quiet)
    std::cerr << "porosph: unstable: " << outcome.message << '\n';
  return exit_of(outcome.status);
}

}  // namespace porosph::app
