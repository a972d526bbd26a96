// Values along a line through the soil of a finished run.
#pragma once

#include <vector>

#include "solver/analysis/frame_values.hpp"
#include "solver/case/case.hpp"

namespace porosph {

/// A stretch of a section within one soil, from where the line enters the soil to where it leaves it.
struct SectionPiece {
  int soil = -1;               ///< its number in the case, -1 where that is not known
  std::vector<double> along;   ///< distance from the line's first point, increasing [m]
  std::vector<Point> tangent;  ///< of the line there
  std::vector<Point> starts;   ///< where the soil at these points was at t = 0 [m]
  Frame values;                ///< points: where they are now; all fields of the frame, interpolated
};

/// Cuts the soil, as it lies now, along a polyline [m]. `points`: how many are laid out evenly over the whole
/// line; ends of pieces and corners of the line come in addition.
///
/// Fields are interpolated by moving least squares over particles of the same soil that see each other past
/// its outlines: exact for fields that are linear in each soil, up to walls, free surfaces and boundaries
/// between soils, all of which are found to the last digits from the case's outlines and the displacements.
/// Without a case or displacements a piece ends three quarters of a spacing beyond the outermost particles,
/// and soils are not told apart.
///
/// `fields`: what will be asked of the values; strains are computed from the particles beforehand.
/// Empty where the line does not meet the soil. Throws std::invalid_argument for a line of less than two
/// points, of no length, or for fewer than 2 `points`; std::runtime_error for a field that the frame cannot
/// show.
std::vector<SectionPiece> cut(const Frame& frame, const Case* scene, const std::vector<Point>& line,
                              int points, const std::vector<FieldSelection>& fields);

/// The integrals of the stress over a section, per metre of thickness [N/m]: normal, positive in tension, and
/// shear, along the line on the soil to its left.
struct SectionForce {
  double normal = 0, shear = 0;
};

/// Of `stress`, EffectiveStress or TotalStress.
SectionForce force_through(const std::vector<SectionPiece>& pieces, const std::string& stress);

/// The integral of the DarcyVelocity over a section, per metre of thickness [m2/s]: positive to the left of
/// the line.
double flow_through(const std::vector<SectionPiece>& pieces);

}  // namespace porosph
