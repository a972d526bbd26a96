// porosph stability: sweeps settings of a case and classes each run.
#include <fmt/format.h>

#include <iostream>

#include "app/command.hpp"
#include "app/interruption.hpp"
#include "app/say.hpp"
#include "app/threads.hpp"
#include "solver/case/case_file.hpp"
#include "solver/sweep/run_sweep.hpp"
#include "vtk_io/run_folder/folder_lock.hpp"
#include "vtk_io/run_folder/verdict_table.hpp"
#ifdef POROSPH_HAS_VTK
#include "vtk_io/fem_measure.hpp"
#endif
#ifdef POROSPH_HAS_RENDER
#include "render/report/stability.hpp"
#endif

namespace porosph::app {

#ifdef POROSPH_HAS_RENDER
using namespace render;
#endif

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::vector<Sweep> sweeps;
  fs::path folder;
  int jobs = 1;
  bool restart = false, quiet = false;
  std::string command = "porosph stability";
};

Sweep sweep_of_flags(const po::variables_map& values, const std::vector<std::string>& vary) {
  if (vary.size() > 2) throw UsageError(fmt::format("--vary is given {} times; at most twice", vary.size()));
  Sweep sweep;
  sweep.case_file = values["case"].as<std::string>();
  sweep.name = sweep.case_file.stem().string();
  sweep.x = parse_axis(vary[0]);
  sweep.y = vary.size() > 1 ? parse_axis(vary[1]) : SweepAxis{"", {{"", {}}}};
  sweep.title = sweep.name + ": " + sweep.x.title + (vary.size() > 1 ? " and " + sweep.y.title : "");
  return sweep;
}

void change_by_flags(Sweep& sweep, const po::variables_map& values,
                     const std::vector<std::string>& overrides) {
  sweep.settings.insert(sweep.settings.end(), overrides.begin(), overrides.end());
  if (values.count("reference") > 0) try {
      sweep.reference = parse_reference(values["reference"].as<std::string>());
    } catch (const CaseError& error) {
      throw UsageError(fmt::format("--reference: {}", error.what()));
    }
  for (const auto& [name, limit] : {std::pair{"accurate-below", &sweep.limits.accurate},
                                    std::pair{"settled-below", &sweep.limits.settled}}) {
    if (values.count(name) == 0) continue;
    *limit = values[name].as<double>();
    if (!(*limit > 0 && *limit < never)) throw UsageError(fmt::format("--{} must be > 0", name));
  }
}

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  std::vector<std::string> files, vary, overrides;
  std::string folder;
  po::options_description options;
  options.add_options()("sweep", po::value(&files), "sweep files")(
      "case", po::value<std::string>()->value_name("CASE.toml"), "without a sweep file: the case")(
      "vary", po::value(&vary)->value_name("KEY=V1,V2,..."),
      "without a sweep file: a setting and its values; twice for a map of two settings")(
      "set", po::value(&overrides)->value_name("KEY=VALUE"),
      "replaces a setting of all runs; may be given again")(
      "reference", po::value<std::string>()->value_name("case|weight_above|fem|energy"),
      "what sigma'_yy at rest is compared with (default: the sweep's, or the exact solution that the case "
      "names)")("accurate-below", po::value<double>()->value_name("ERROR"),
                "largest relative L2 error called accurate (default: the sweep's, or 0.02)")(
      "settled-below", po::value<double>()->value_name("RATIO"),
      "largest unbalanced force ratio at rest (default: the sweep's, or 0.001)")(
      "quick", "the few values that a sweep file names for a quick look");
  add_jobs(options, o.jobs, "runs at a time");
  options.add_options()("restart", "computes again what is there")("quiet",
                                                                   "say nothing unless something is wrong")(
      "out", po::value(&folder)->value_name("DIR")->default_value("results/stability"),
      "folder for index.html and <sweep>.csv, <sweep>.png; runs that are there already are kept");
  po::positional_options_description positional;
  positional.add("sweep", -1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "stability [SWEEP.toml...] [options]",
             "  porosph stability cases/stability/courant_damping.toml --quick\n"
             "  porosph stability --case cases/foundation.toml --vary time.courant=0.2,0.9,1.5 \\\n"
             "      --vary loading.damping=0.01,0.1 --set particles.spacing=0.5\n",
             values))
    return std::nullopt;
  if (files.empty() == (values.count("case") == 0) || files.empty() == vary.empty())
    throw UsageError(
        "stability needs sweep files, or --case with --vary; porosph stability --help shows both");
  check_jobs(o.jobs);
  for (const std::string& file : files) o.sweeps.push_back(read_sweep(file, values.count("quick") > 0));
  if (files.empty()) o.sweeps.push_back(sweep_of_flags(values, vary));
  for (Sweep& sweep : o.sweeps) change_by_flags(sweep, values, overrides);
  for (std::size_t i = 0; i < o.sweeps.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (o.sweeps[i].name == o.sweeps[j].name)
        throw UsageError(fmt::format("two sweeps are called '{}'", o.sweeps[i].name));
  o.folder = folder;
  o.restart = values.count("restart") > 0, o.quiet = values.count("quiet") > 0;
  for (const std::string& argument : arguments) o.command += " " + argument;
  return o;
}

ErrorMeasure measure_of(SweepReference reference, const Case& scene) {
  if (reference == SweepReference::weight_above) return weight_measure(scene);
  if (reference == SweepReference::energy) return energy_measure(scene);
#ifdef POROSPH_HAS_VTK
  if (reference == SweepReference::fem) return fem_measure(scene);
#else
  if (reference == SweepReference::fem)
    throw std::runtime_error("built without VTK: no finite-element meshes");
#endif
  return exact_measure(scene);
}

/// Runs a sweep into its folder, a row of its table as soon as a run is finished.
class SweepFolder {
 public:
  SweepFolder(const Sweep& sweep, const Options& options)
      : sweep_(sweep),
        options_(options),
        table_(options.folder / (sweep.name + ".csv")),
        known_(rows_there()) {
    writer_.emplace(table_, known_);
  }

  std::vector<std::optional<Verdict>> run() {
    const MeasureMaker measure = [this](const Case& scene) { return measure_of(sweep_.reference, scene); };
    auto verdicts = run_sweep(
        sweep_, measure, options_.jobs,
        {.known = [this](std::size_t i, const std::string& f) { return recall(i, f); },
         .finished = [this](std::size_t i, const std::string& f, const Verdict& v) { keep(i, f, v); },
         .interrupted = is_interrupted});
    if (!is_interrupted()) sort_table();
    return verdicts;
  }

 private:
  std::vector<VerdictRow> rows_there() {
    if (options_.restart || !fs::exists(table_)) return {};
    return read_verdicts(table_);
  }

  std::string x(std::size_t i) const { return sweep_.x.values[i % sweep_.x.values.size()].label; }
  std::string y(std::size_t i) const { return sweep_.y.values[i / sweep_.x.values.size()].label; }

  std::optional<Verdict> recall(std::size_t i, const std::string& fingerprint) {
    for (const VerdictRow& row : known_)
      if (row.fingerprint == fingerprint) {
        done_.emplace_back(i, VerdictRow{x(i), y(i), fingerprint, row.verdict});
        return row.verdict;
      }
    return std::nullopt;
  }

  void keep(std::size_t i, const std::string& fingerprint, const Verdict& v) {
    done_.emplace_back(i, VerdictRow{x(i), y(i), fingerprint, v});
    writer_->append(done_.back().second);
    if (options_.quiet) return;
    say(stdout,
        fmt::format("{}: {} {}: {}{}\n", sweep_.name, x(i), y(i), class_name(v.outcome),
                    v.message.empty() ? fmt::format(", error {:.3g} %", 100 * v.error) : ": " + v.message));
  }

  /// In the sweep's order, without rows of other settings.
  void sort_table() {
    std::sort(done_.begin(), done_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<VerdictRow> rows;
    for (const auto& [i, row] : done_) rows.push_back(row);
    write_verdicts(table_, rows);
  }

  const Sweep& sweep_;
  const Options& options_;
  fs::path table_;
  std::vector<VerdictRow> known_;
  std::optional<VerdictWriter> writer_;
  std::vector<std::pair<std::size_t, VerdictRow>> done_;
};

}  // namespace

int stability_command(const Arguments& arguments) {
  const auto options = read_options(arguments);
  if (!options) return Exit::done;
  catch_interruptions();
  const FolderLock lock(options->folder);
#ifdef POROSPH_HAS_RENDER
  std::vector<SweptMap> maps;
#endif
  for (const Sweep& sweep : options->sweeps) {
    const auto verdicts = SweepFolder(sweep, *options).run();
    if (is_interrupted()) {
      std::cerr << "porosph: interrupted; the same command continues from here\n";
      return Exit::interrupted;
    }
#ifdef POROSPH_HAS_RENDER
    maps.push_back({sweep, verdicts, usual_values(sweep, sweep.x), usual_values(sweep, sweep.y)});
    save_stability_map(maps.back(), options->folder / (sweep.name + ".png"));
#endif
  }
#ifdef POROSPH_HAS_RENDER
  write_stability_study(maps, options->command, options->folder);
  if (!options->quiet) say(stdout, (options->folder / "index.html").string() + "\n");
#else
  if (!options->quiet)
    say(stdout, options->folder.string() + ": a table of each sweep; built without pictures\n");
#endif
  return Exit::done;
}

}  // namespace porosph::app
