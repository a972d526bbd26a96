// Values at any point of a frame's soil.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solver/analysis/frame_values.hpp"
#include "solver/case/case.hpp"

namespace porosph {

/// The soil that lies at a point now.
struct InSoil {
  static constexpr int outside = -2;
  int soil = outside;                  ///< its number; -1 where soils are not told apart
  Point start = Point::Zero();         ///< where it was at t = 0 [m]
  std::vector<std::size_t> particles;  ///< that its values are interpolated from
  bool in_soil() const { return soil != outside; }
};

/// Interpolates by moving least squares over particles of the same soil that see each other past its
/// outlines: exact for fields that are linear in each soil. The soil ends where the case's outlines have
/// moved to, or, where these are not known, three quarters of a spacing beyond the outermost particles.
class SoilValues {
 public:
  /// `smoothing_length`, `spacing` [m]. Integers of the frame become real numbers.
  SoilValues(Frame particles, const Case* scene, double smoothing_length, double spacing);
  ~SoilValues();
  SoilValues(SoilValues&&) noexcept;

  /// `slack`: how far from the outline a point still counts as inside [m].
  InSoil at(const Point& p, double slack) const;

  /// The frame without its particles: what append() adds points to.
  Frame no_points() const;
  /// Adds a point that is in the soil, with the values of all fields there.
  void append(Frame& values, const InSoil& hit, const Point& p) const;

  /// Points this near to an outline may be on it: displacements have errors of second order. 0 where outlines
  /// are not known.
  double slack() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> impl_;
};

/// The values of those particles of the frame that `near` chooses by their place [m] and the smoothing length
/// [m]; with strains where one of the `fields` needs them, which are derivatives over all particles. Empty
/// where none is chosen. Throws std::runtime_error for a field that the frame cannot show, or where the
/// spacing of the particles is not known.
std::optional<SoilValues> soil_values(const Frame& frame, const Case* scene,
                                      const std::vector<FieldSelection>& fields,
                                      const std::function<bool(const Point&, double)>& near);

/// Of the case, or from mass and density [m]. Throws std::runtime_error.
double spacing_of(const Frame& frame, const Case* scene);

}  // namespace porosph
