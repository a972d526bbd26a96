#include "vtk_io/finished_run/finished_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/analysis/derived_fields.hpp"
#include "solver/case/case_file.hpp"
#include "vtk_io/particle_data.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/run_folder/history_csv.hpp"
#include "vtk_io/run_folder/summary_json.hpp"

namespace porosph {
namespace fs = std::filesystem;

FinishedRun open_run(const fs::path& path) {
  const bool is_folder = fs::is_directory(path);
  const fs::path pvd = is_folder ? path / "particles.pvd" : path;
  if (!fs::exists(pvd))
    throw ReadError(pvd, is_folder ? "the folder holds no series of particles (was it run with --no-frames?)"
                                   : "there is no such file");
  FinishedRun run;
  run.folder = pvd.parent_path().empty() ? fs::path(".") : pvd.parent_path();
  run.name = fs::weakly_canonical(run.folder).filename().string();
  run.series = open_series(pvd);
  if (fs::exists(run.folder / "case.toml")) run.scene = read_case(run.folder / "case.toml");
  if (run.scene) run.label = run.scene->label;
  if (fs::exists(run.folder / "summary.json")) run.summary = read_summary(run.folder / "summary.json");
  if (fs::exists(run.folder / "history.csv")) run.history = read_history(run.folder / "history.csv").history;
  return run;
}

std::vector<std::string> run_labels(const std::vector<FinishedRun>& runs) {
  const auto short_name = [](const FinishedRun& run) { return run.label.empty() ? run.name : run.label; };
  std::vector<std::string> labels;
  for (const FinishedRun& run : runs) {
    const auto alike = std::count_if(runs.begin(), runs.end(),
                                     [&](const auto& r) { return short_name(r) == short_name(run); });
    labels.push_back(alike > 1 ? run.folder.string() : short_name(run));
  }
  return labels;
}

void set_labels(std::vector<FinishedRun>& runs, const std::vector<std::string>& labels) {
  if (labels.empty()) return;
  if (labels.size() != runs.size())
    throw std::runtime_error(fmt::format(
        "--label is given {} time{} for {} run{}; it must be given once for each run, in their order",
        labels.size(), labels.size() == 1 ? "" : "s", runs.size(), runs.size() == 1 ? "" : "s"));
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].label = labels[i];
}

bool ends_at_rest(const FinishedRun& run) {
  return run.summary && run.summary->status == RunStatus::equilibrium;
}

Frame frame_of(const FinishedRun& run, std::size_t frame) {
  Frame read = frame_of(*read_frame(run.series.file(frame)));
  if (run.scene && run.scene->water.present()) add_water_unit_weight(read, run.scene->water.unit_weight);
  return read;
}

std::size_t frame_at(const Series& series, double time) {
  const auto& frames = series.frames;
  const double first = frames.front().time, last = frames.back().time;
  const double slack = frames.size() > 1 ? 0.5 * (last - first) / static_cast<double>(frames.size() - 1) : 0;
  if (!(time >= first - slack && time <= last + slack))
    throw std::runtime_error(fmt::format(
        "time {:g} s is outside of the series, which goes from {:g} s to {:g} s", time, first, last));
  const auto nearest = std::min_element(frames.begin(), frames.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
  return static_cast<std::size_t>(nearest - frames.begin());
}

}  // namespace porosph
