// The report of runs: one page with its pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "render/report/report_pictures.hpp"
#include "vtk_io/run_folder/threshold.hpp"

namespace porosph::render {

struct ReportInput {
  std::vector<FinishedRun> runs;               ///< at least one
  std::optional<FemReference> fem;             ///< what they are compared with beside their own reference
  std::vector<LeftOut> left_out;               ///< of the norms against finite elements
  std::vector<Threshold> thresholds;           ///< each is checked for each run
  std::vector<std::filesystem::path> studies;  ///< folders of studies, each shown as a section
  std::vector<ReportField> fields;             ///< to draw; empty: vertical stresses and displacement
  std::vector<SectionLine> sections;           ///< empty: verticals through the probes
  std::size_t instants = 20;                   ///< of the player; less than 2: none
  std::string command;                         ///< the command line that makes this report
  std::string made;                            ///< when, by which program, on which machine
  bool single_file = false;                    ///< the pictures go into the page
  std::filesystem::path summary;               ///< a file for a summary in Markdown; empty: none
};

/// Writes index.html, its PNGs and report.json into `folder`; pictures are the same for the same runs.
/// Returns the thresholds that failed, as text. Throws std::runtime_error for a run without case or summary
/// or of another body than the first, and for a threshold on a number that is not there; ReadError,
/// WriteError.
std::vector<std::string> write_report(const ReportInput& input, const std::filesystem::path& folder);

}  // namespace porosph::render
