// Sections of runs as charts and as a table, with what theory and finite elements say behind them.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/chart.hpp"
#include "solver/analysis/section.hpp"
#include "vtk_io/finished_run/fem_reference.hpp"
#include "vtk_io/finished_run/finished_run.hpp"

namespace porosph::render {

/// Where a section is.
struct SectionLine {
  enum Kind { vertical, level, polyline } kind = polyline;
  std::vector<Point> points;  ///< for polyline: two or more [m]
  double at = 0;              ///< for the others: x or y [m]

  /// "x = 5 m", "(0, 1) to (5, 2) m".
  std::string text() const;
};

/// A line that does not meet the soil.
struct NoSoil : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One run's section at one time.
struct RunSection {
  std::string label;
  double time = 0;    ///< [s]
  double origin = 0;  ///< what the chart's axis shows at the line's first point: its x or y, or 0 [m]
  std::vector<SectionPiece> pieces;
};

/// Throws NoSoil, and what cut throws. `points`: 0 for two
/// per spacing of the particles.
RunSection section_of(const FinishedRun& run, const std::string& label, const Frame& frame,
                      const SectionLine& line, int points, const std::vector<FieldSelection>& fields);

/// The same soil in the state of rest that theory or finite elements give, its places shifted along the line
/// by the difference in displacement; empty for a case without a reference.
std::optional<RunSection> exact_section(const Case& scene, const RunSection& section);
RunSection fem_section(const FemReference& fem, const RunSection& section);

/// One field over the section: over height for a vertical one. `references`: drawn grey behind the runs;
/// those that do not have the field are left out.
Chart section_chart(const SectionLine& line, const std::vector<RunSection>& sections,
                    const std::vector<RunSection>& references, const FieldSelection& field);

/// Lays the charts of a section out side by side, or one below the other.
ChartFigure section_figure(const SectionLine& line, std::vector<Chart> charts, const std::string& title);

/// A table in SI units: run, time, distance along the line, places now and at t = 0, soil, one column per
/// field; empty cells where a reference does not have a field.
std::string section_csv(const std::vector<RunSection>& sections, const std::vector<FieldSelection>& fields);

}  // namespace porosph::render
