// The folder of a run: whose it is, and the files in it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/written_files.hpp"
#include "solver/run/run.hpp"
#include "vtk_io/run_folder/checkpoint.hpp"
#include "vtk_io/run_folder/history_csv.hpp"
#ifdef POROSPH_HAS_VTK
#include "vtk_io/particle_series.hpp"
#endif

namespace porosph::app {

/// Throws UsageError where a run of this case would write over what is not its own: another case's results or
/// case file, or (unless it is resumed) an interrupted run.
void check_owner(const std::filesystem::path& folder, const std::string& case_text, bool resume);

/// Makes the folder one of this case: removes what is there of another, and writes its case file. Throws
/// WriteError.
void take_folder(const std::filesystem::path& folder, const std::string& case_text);

/// Makes the interrupted or finished run of `folder` one of this case, which differs in its end and time step
/// only; `state` is its checkpoint. Killed at any moment it leaves a run that can be resumed. Throws
/// WriteError.
void extend_run(const std::filesystem::path& folder, const std::string& case_text, const StateBytes& state);

/// How a run of the folder ended, if it is done and not interrupted.
std::optional<Summary> finished_summary(const std::filesystem::path& folder);

/// The folder's files, fed by the run. All members throw WriteError.
class Results {
 public:
  /// Begins at the start: what an earlier run wrote there is removed.
  /// `scene`: the case with all of its stages.
  Results(const std::filesystem::path& folder, const Case& scene, const Simulation& simulation, bool frames);

  /// Continues the files of the run that left off at `progress`: what they hold beyond is removed. Throws
  /// ReadError where they are not those that the run wrote; UsageError where it wrote frames and this one
  /// does not, or the other way round.
  Results(const std::filesystem::path& folder, const Case& scene, const Simulation& simulation, bool frames,
          const RunProgress& progress, const WrittenFiles& written);

  void frame(Simulation& simulation);
  void row(const std::vector<double>& values) { history_.append(values); }
  void checkpoint(const StateBytes& state);
  WrittenFiles written() const;
  /// `state`: a checkpoint at the end, kept where the run came to rest, for other runs to start from.
  void finish(const Summary& summary, const StateBytes& state);

 private:
  std::filesystem::path folder_;
  std::string case_text_;
  HistoryWriter history_;
#ifdef POROSPH_HAS_VTK
  std::optional<SeriesWriter> series_;
#endif
};

}  // namespace porosph::app
