// The pictures of a report.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/report/html.hpp"
#include "render/run/section_chart.hpp"
#include "vtk_io/finished_run/norms.hpp"

namespace porosph::render {

struct ReportPicture {
  std::string file, description, caption;
  std::vector<std::string> panels = {};  ///< of several: files with one each, for narrow windows
};

/// A field that a report draws.
struct ReportField {
  FieldSelection field;
  std::optional<ValueRange> range;  ///< of its colours, as shown; default: by the values
};

struct LoadedRun {
  const FinishedRun& run;
  std::string label;
  Frame last;  ///< the last frame
};

/// Geometry, soils, boundaries, water and probes, as they are at the start of the first run.
ReportPicture draw_case(const LoadedRun& run, const std::filesystem::path& folder);

/// The last frames, and finite elements, with one range of colours for all.
ReportPicture draw_contours(const std::vector<LoadedRun>& runs, const std::optional<FemReference>& fem,
                            const ReportField& shown, const std::filesystem::path& folder);

/// Maps of difference_maps, with norms; none where nothing can be compared.
std::optional<ReportPicture> draw_differences(const std::vector<LoadedRun>& runs,
                                              const std::optional<FemReference>& fem,
                                              const std::vector<LeftOut>& left_out,
                                              const FieldSelection& field,
                                              const std::filesystem::path& folder);

/// Effective vertical stress over time at each probe, with theory; none without histories.
std::optional<ReportPicture> draw_histories(const std::vector<FinishedRun>& runs,
                                            const std::vector<std::string>& labels,
                                            const std::filesystem::path& folder);

/// A field along sections at the end of all runs, with theory and finite elements; and sections.csv, which
/// holds the numbers. Without `lines` on the verticals through the first three probes, or through the middle
/// of the soil. None where no line meets the soil.
std::optional<ReportPicture> draw_sections(const std::vector<LoadedRun>& runs,
                                           const std::optional<FemReference>& fem,
                                           const std::vector<SectionLine>& lines, const FieldSelection& field,
                                           const std::filesystem::path& folder);

/// Settlement over time; none without histories.
std::optional<ReportPicture> draw_settlement(const std::vector<FinishedRun>& runs,
                                             const std::vector<std::string>& labels,
                                             const std::filesystem::path& folder);

/// The balance of water and discharge over time; none where no run has them in its history.
std::optional<ReportPicture> draw_water(const std::vector<FinishedRun>& runs,
                                        const std::vector<std::string>& labels,
                                        const std::filesystem::path& folder);

/// p'-q and s'-t paths and Mohr's circle at each probe in soil that has a strength; none where there is none.
std::optional<ReportPicture> draw_stress_paths(const std::vector<FinishedRun>& runs,
                                               const std::vector<std::string>& labels,
                                               const std::filesystem::path& folder);

/// The four effective stresses over time at one probe, with what finite elements say; none without histories.
std::optional<ReportPicture> draw_probe(const std::vector<LoadedRun>& runs, const FemReference& fem,
                                        const ProbeCase& probe, const std::filesystem::path& folder);

/// Six instants of one run, closer together at its start; with or without its panels one by one.
ReportPicture draw_development(const LoadedRun& run, const ReportField& shown, bool panels,
                               const std::filesystem::path& folder);

/// Pictures of one size and range: at most `most` instants of one run, evenly chosen, the first and the last
/// among them.
std::vector<html::Instant> draw_instants(const LoadedRun& run, const ReportField& shown, std::size_t most,
                                         const std::filesystem::path& folder);

/// The ends of two runs as pictures of one size and range.
std::vector<html::Instant> draw_pair(const LoadedRun& a, const LoadedRun& b, const ReportField& shown,
                                     const std::filesystem::path& folder);

}  // namespace porosph::render
