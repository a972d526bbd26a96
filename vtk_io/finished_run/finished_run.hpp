// The folder that a run left, opened for pictures and reports.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/output/frame.hpp"
#include "vtk_io/read_series.hpp"

namespace porosph {

struct FinishedRun {
  std::filesystem::path folder;
  std::string name;   ///< the folder's own name
  std::string label;  ///< what the command line or else the case calls it; may be empty
  Series series;
  std::optional<Case> scene;       ///< case.toml beside the series, if there is one
  std::optional<Summary> summary;  ///< summary.json, as above
  std::optional<History> history;  ///< history.csv, as above
};

/// `path` is the run's folder or a .pvd in it. Throws ReadError, or CaseError for a case.toml that does not
/// hold a case.
FinishedRun open_run(const std::filesystem::path& path);

/// The runs' own labels, or else the folders' names; the whole path where two are alike.
std::vector<std::string> run_labels(const std::vector<FinishedRun>& runs);

/// Gives the runs labels in their order. Throws std::runtime_error unless there are as many as runs, or none.
void set_labels(std::vector<FinishedRun>& runs, const std::vector<std::string>& labels);

/// One frame of the run. Throws ReadError.
Frame frame_of(const FinishedRun& run, std::size_t frame);

/// Whether the run came to rest at the end, so that its last frame stands for any later time.
bool ends_at_rest(const FinishedRun& run);

/// The frame nearest to `time` [s]. Throws std::runtime_error, naming the series' first and last time, for a
/// time further outside of it than half the distance between its frames.
std::size_t frame_at(const Series& series, double time);

}  // namespace porosph
