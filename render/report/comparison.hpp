// Two runs side by side: pictures, histories and norms.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "render/contour.hpp"
#include "vtk_io/finished_run/norms.hpp"

namespace porosph::render {

struct ComparisonChoice {
  std::vector<FieldSelection> pictures;  ///< fields to draw
  double deformation = 1;
  FieldStyle style = FieldStyle::particles;
  std::optional<ValueRange> range, difference_range;  ///< of the colours, as shown; default: by the values
  std::vector<LeftOut> left_out;                      ///< of the norms against finite elements
};

struct Comparison {
  double time_a = 0, time_b = 0;  ///< [s]
  bool particle_by_particle = true;
  std::size_t points = 0;
  std::vector<FieldNorms> a_against_b;
  std::vector<FieldNorms> a_against_fem, b_against_fem;  ///< empty without the reference
  std::vector<std::string> pictures;                     ///< file names in the folder
};

/// Writes FIELD.png per field and history.png into `folder`. `frame_a`, `frame_b`: numbers of the frames.
/// Throws std::runtime_error with the reason if the runs cannot be compared, what drawing throws, ReadError,
/// WriteError.
Comparison compare_runs(const FinishedRun& a, std::size_t frame_a, const FinishedRun& b, std::size_t frame_b,
                        const std::optional<FemReference>& fem, const ComparisonChoice& choice,
                        const std::filesystem::path& folder);

/// What the finite elements say, drawn at the run's particles.
ContourPanel fem_panel(const FemReference& fem, const FinishedRun& run, const Frame& frame,
                       const FieldSelection& field, double factor, double deformation = 1,
                       FieldStyle style = FieldStyle::particles);

/// One map for each difference in one field: of every other run from the first, where their last frames may
/// be compared, and of every run from finite elements. Empty where there is none.
ContourFigure difference_maps(const std::vector<const FinishedRun*>& runs,
                              const std::vector<const Frame*>& frames, const std::vector<std::string>& labels,
                              const std::optional<FemReference>& fem, const std::vector<LeftOut>& left_out,
                              const FieldSelection& field);

/// comparison.csv and comparison.json in `folder`. Numbers that are not finite: empty, and null with a
/// reason.
void write_norms(const Comparison& comparison, const std::string& label_a, const std::string& label_b,
                 const std::filesystem::path& folder);

/// "0.12 %", or "reference is zero".
std::string relative_text(double relative_l2);

/// "1.2 kPa at (0.1, 9.9) m".
std::string largest_text(const FieldNorms& norms);

}  // namespace porosph::render
