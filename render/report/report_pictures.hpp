// The pictures of a report.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/run/norms.hpp"

namespace porosph {

struct ReportPicture {
  std::string file, description, caption;
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
                            const FieldSelection& field, const std::filesystem::path& folder);

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

/// Effective vertical stress with height at the end of all runs, on the verticals through the first three
/// probes (or through the middle of the soil), with theory and finite elements; and section.csv, which holds
/// the numbers. None where no vertical meets the soil.
std::optional<ReportPicture> draw_sections(const std::vector<LoadedRun>& runs,
                                           const std::optional<FemReference>& fem,
                                           const std::filesystem::path& folder);

/// The four effective stresses over time at one probe, with what finite elements say; none without histories.
std::optional<ReportPicture> draw_probe(const std::vector<LoadedRun>& runs, const FemReference& fem,
                                        const ProbeCase& probe, const std::filesystem::path& folder);

/// Six instants of one run, closer together at its start.
ReportPicture draw_development(const LoadedRun& run, const FieldSelection& field,
                               const std::filesystem::path& folder);

}  // namespace porosph
