#include "app/results.hpp"

#include <fmt/format.h>

#include "app/command.hpp"
#include "solver/case/case_file.hpp"
#include "solver/output/boundary_frame.hpp"
#include "solver/output/fields.hpp"
#include "solver/output/sheet_frames.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/run_folder/summary_json.hpp"

namespace porosph::app {
namespace fs = std::filesystem;

namespace {

constexpr const char *case_name = "case.toml", *history_name = "history.csv", *summary_name = "summary.json",
                     *series_name = "particles.pvd", *frames_name = "frames";

/// Whether a case file means the same as this text, whatever it looks like.
bool is_case(const fs::path& file, const std::string& case_text) {
  try {
    return write_case(read_case(file)) == case_text;
  } catch (const CaseError&) {
    return false;
  }
}

bool holds_results(const fs::path& folder) {
  return fs::exists(folder / history_name) || fs::exists(folder / summary_name) ||
         fs::exists(folder / series_name) || has_checkpoint(folder);
}

bool is_of_another(const fs::path& folder, const std::string& case_text) {
  const fs::path case_file = folder / case_name;
  return fs::exists(case_file) ? !is_case(case_file, case_text) : holds_results(folder);
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw WriteError(file, error.message());
}

void remove_safety(const fs::path& folder) {
  for (const char* name : {"safety.csv", "safety.json", "safety.png", "mechanism.png", "slip_surfaces.csv",
                           "slip_surfaces.vtp", "index.html", "study.json"})
    remove_file(folder / name);
}

void remove_results(const fs::path& folder) {
  remove_checkpoints(folder);
  for (const char* name :
       {summary_name, series_name, "open_in_paraview.py", "compare_in_paraview.py", history_name})
    remove_file(folder / name);
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / frames_name, none)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("particles_") || name.starts_with("boundary_") || name.starts_with("sheets_"))
      remove_file(entry.path());
  }
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().filename().string().starts_with("safety_") && fs::exists(entry.path() / "safety.json"))
      remove_safety(entry.path());
}

/// Of runs, of finite elements and of factors of safety.
void remove_what_is_of_another(const fs::path& folder, const std::string& case_text) {
  if (!is_of_another(folder, case_text)) return;
  remove_results(folder);
  for (const char* name : {"fem.vtu", "probes.csv"}) remove_file(folder / name);
  remove_safety(folder);
}

/// Takes the folder for this case, empty of a run's results. The case file comes last: what is in the folder
/// is never that of another.
fs::path taken(const fs::path& folder, const std::string& case_text, const std::string& remark) {
  remove_what_is_of_another(folder, case_text);
  remove_results(folder);
  write_file(folder / case_name, remark + case_text);
  return folder / history_name;
}

#ifdef POROSPH_HAS_VTK
/// The case without its end and step: a run that is given a later end keeps the frames that it has.
std::string case_in_frames(Case scene) {
  scene.time.step = TimeCase{}.step;
  std::string text = write_case(scene);
  const auto at = text.find("\nend = ", text.find("\n[time]\n"));
  return text.replace(at + 1, text.find('\n', at + 1) - at - 1, "# end: see the run's case.toml");
}

SeriesOptions series_options(const Case& scene) {
  const OutputCase& chosen = scene.output;
  return {chosen.format, chosen.compression, chosen.precision, script_scene(scene), case_in_frames(scene)};
}
#endif

/// What the program does with the case by itself, as comments at the head of its file.
std::string remark_on(const Simulation& s) {
  const double asked = s.scene().time.courant;
  if (s.courant() >= asked) return "";
  return fmt::format(
      "# The stiffest of the particles allow a Courant number of {} only. It is used in place of\n"
      "# time.courant = {}, also when this file is run again: the time step is {} s.\n",
      s.courant(), asked, s.time_step());
}

bool is_interrupted_run(const fs::path& folder) {
  if (!has_checkpoint(folder)) return false;
  try {
    return !finished_summary(folder);
  } catch (const ReadError&) {
    return true;
  }
}

}  // namespace

void check_owner(const fs::path& folder, const std::string& case_text, bool resume) {
  std::error_code none;
  if (!fs::is_directory(folder, none)) return;
  if (is_of_another(folder, case_text))
    throw UsageError(
        fmt::format("{} holds {} of another case: choose another folder with --out, or give --force to "
                    "replace it",
                    folder.string(), holds_results(folder) ? "results" : "the case file"));
  if (!resume && is_interrupted_run(folder))
    throw UsageError(fmt::format(
        "{} holds an interrupted run of this case: --resume continues it, --force starts it again",
        folder.string()));
}

void extend_run(const fs::path& folder, const std::string& case_text, const StateBytes& state) {
  write_checkpoint(folder, case_text, state);  // that of the earlier end stays beside it
  remove_file(folder / summary_name);
  write_file(folder / case_name, case_text);
}

void take_folder(const fs::path& folder, const std::string& case_text) {
  remove_what_is_of_another(folder, case_text);
  write_file(folder / case_name, case_text);
}

std::optional<Summary> finished_summary(const fs::path& folder) {
  if (!fs::exists(folder / summary_name)) return std::nullopt;
  Summary summary = read_summary(folder / summary_name);
  if (summary.status == RunStatus::interrupted) return std::nullopt;
  return summary;
}

Results::Results(const fs::path& folder, const Case& scene, const Simulation& simulation,
                 [[maybe_unused]] bool frames)
    : folder_(folder),
      case_text_(write_case(scene)),
      history_(taken(folder, case_text_, remark_on(simulation)), history_columns(simulation)) {
#ifdef POROSPH_HAS_VTK
  if (frames) series_.emplace(folder_, series_options(scene));
#endif
}

Results::Results(const fs::path& folder, const Case& scene, const Simulation& simulation, bool frames,
                 const RunProgress& progress, const WrittenFiles& written)
    : folder_(folder),
      case_text_(write_case(scene)),
      history_(HistoryWriter::resume(folder / history_name, history_columns(simulation),
                                     simulation.time_of(progress.recorded), written.history)) {
  if (const bool had_frames = fs::exists(folder_ / series_name); had_frames != frames)
    throw UsageError(fmt::format("the run in {} was started {} frames, and can only be resumed that way",
                                 folder_.string(), had_frames ? "with" : "without"));
#ifdef POROSPH_HAS_VTK
  if (frames)
    series_.emplace(SeriesWriter::resume(folder_, simulation.time_of(progress.framed), written.frames,
                                         series_options(scene)));
#endif
}

void Results::frame([[maybe_unused]] Simulation& s) {
#ifdef POROSPH_HAS_VTK
  if (!series_) return;
  const OutputCase& output = s.scene().output;
  series_->write(make_frame(s, output.fields),
                 output.boundary ? std::optional(make_boundary_frame(s)) : std::nullopt);
  const Case& whole = s.scene().plan ? *s.scene().plan : s.scene();
  if (!whole.sheets.empty()) series_->write_sheets(make_sheet_frames(s));
#endif
}

void Results::checkpoint(const StateBytes& state) {
  history_.sync();  // the rows up to here must not be lost when the state is kept
  write_checkpoint(folder_, case_text_, state);
}

WrittenFiles Results::written() const {
  WrittenFiles written;
  written.history = history_.checksum();
#ifdef POROSPH_HAS_VTK
  if (series_) written.frames = series_->checksums();
#endif
  return written;
}

void Results::finish(const Summary& summary, const StateBytes& state) {
  history_.sync();
  write_summary(folder_ / summary_name, summary);
  if (summary.status == RunStatus::completed)
    keep_newest_checkpoint(folder_);  // a later end time continues from there
  else if (summary.status != RunStatus::interrupted)
    remove_checkpoints(folder_);
  if (summary.status == RunStatus::equilibrium) write_checkpoint(folder_, case_text_, state);
}

}  // namespace porosph::app
