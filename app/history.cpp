// porosph history: what probes recorded, as charts.
#include <fmt/format.h>

#include <iostream>
#include <map>

#include "app/command.hpp"
#include "app/picture_options.hpp"
#include "render/run/history_lines.hpp"
#include "render/run/stress_paths.hpp"
#include "render/run/water_curves.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::app {

using namespace render;

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> runs, labels, probes;
  std::string show, out;
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  po::options_description options;
  options.add_options()("run", po::value(&o.runs)->required(), "folders of runs")(
      "show", po::value(&o.show)->value_name("stress|settlement|water|pq|st|mohr")->default_value("stress"),
      "vertical effective stress or settlement over time, the balance and discharge of water, stress paths q "
      "over p' or t over s', or Mohr's "
      "circle "
      "at the end; with the strength of the soil around the probe")(
      "probe", po::value(&o.probes)->value_name("NAME"), "only this one; may be given again (default: all)")(
      "label", po::value(&o.labels)->value_name("TEXT"),
      "what to call a run; given once for each run, in their order (default: the folder's name)")(
      "out", po::value(&o.out)->value_name("FILE.png"),
      "the chart: .png, .svg or .pdf (default: history_SHOW.png in the first run's folder)");
  po::positional_options_description positional;
  positional.add("run", -1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "history RUN... [options]",
             "  porosph history results/foundation --show settlement\n"
             "  porosph history results/foundation --show st --probe A --out path.svg\n",
             values))
    return std::nullopt;
  return o;
}

/// The runs' cases with the probes that were asked for.
void choose_probes(std::vector<FinishedRun>& runs, const std::vector<std::string>& names) {
  for (FinishedRun& run : runs) {
    if (!run.scene || run.scene->probes.empty() || !run.history)
      throw UsageError(fmt::format("{}: has no probes: give the case a [[probe]]", run.folder.string()));
    std::vector<std::string> there;
    for (const ProbeCase& probe : run.scene->probes) there.push_back(probe.name);
    for (const std::string& name : names)
      if (std::ranges::find(there, name) == there.end())
        throw UsageError(
            fmt::format("--probe = {}: {} has {}", name, run.folder.string(), fmt::join(there, ", ")));
    if (!names.empty())
      std::erase_if(run.scene->probes, [&](const ProbeCase& probe) {
        return std::ranges::find(names, probe.name) == names.end();
      });
  }
}

std::vector<Chart> water_charts(const std::vector<FinishedRun>& runs) {
  std::vector<Chart> charts = water_curves(runs, run_labels(runs));
  if (charts.empty())
    throw UsageError(
        fmt::format("{}: its history has no water that flows over time (water.mode = \"transient\")",
                    runs.front().folder.string()));
  return charts;
}

std::vector<Chart> charts_of(const std::vector<FinishedRun>& runs, const std::string& show) {
  static const std::map<std::string, PathKind> paths = {
      {"pq", PathKind::pq}, {"st", PathKind::st}, {"mohr", PathKind::mohr}};
  const std::vector<std::string> labels = run_labels(runs);
  if (const auto kind = paths.find(show); kind != paths.end())
    return stress_paths(runs, labels, kind->second);
  if (show == "stress") return stress_histories(runs, labels);
  if (show == "settlement") return settlement_curves(runs, labels);
  throw UsageError(fmt::format("--show = {}: must be stress, settlement, water, pq, st or mohr", show));
}

}  // namespace

int history_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  std::vector<FinishedRun> runs;
  for (const std::string& folder : o->runs) runs.push_back(open_run(folder));
  set_labels(runs, o->labels);
  if (o->show != "water") choose_probes(runs, o->probes);
  std::vector<Chart> charts = o->show == "water" ? water_charts(runs) : charts_of(runs, o->show);
  const fs::path path =
      o->out.empty() ? runs.front().folder / fmt::format("history_{}.png", o->show) : fs::path(o->out);
  require_picture_name(path);
  if (path.has_parent_path()) make_folder(path.parent_path());
  const int columns = charts.size() > 2 ? 2 : 1;
  save_charts({.title = runs.front().scene->title, .charts = std::move(charts), .columns = columns}, path);
  std::cout << path.string() << '\n';
  return Exit::done;
}

}  // namespace porosph::app
