#include "solver/model/initial_velocity.hpp"

#include <algorithm>

#include "solver/reference/exact/cantilever.hpp"

namespace porosph {
namespace {

/// Of the first mode of Timoshenko's plate, for a velocity of 1 at its tip. Lattice sites may lie on the
/// outline but not beyond it, so x is within the plate up to round-off.
Point bending_velocity(const SoilCase& soil, double density, const Point& low, const Point& high,
                       const Point& position) {
  const Cantilever plate{.length = high.x() - low.x(),
                         .thickness = high.y() - low.y(),
                         .youngs_modulus = soil.youngs_modulus,
                         .poissons_ratio = soil.poissons_ratio,
                         .density = density};
  const double x = std::clamp(position.x() - low.x(), 0.0, plate.length);
  const BendingShape shape = thick_plate_shape(plate, x);
  return {-shape.rotation * (position.y() - (low.y() + high.y()) / 2), shape.deflection};
}

}  // namespace

Point initial_velocity(const SoilCase& soil, double density, const Point& position) {
  Point velocity = soil.velocity;
  if (soil.angular_velocity == 0 && soil.bending_velocity == 0) return velocity;
  Point low = soil.polygon[0], high = low;
  for (const Point& p : soil.polygon) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Point arm = position - (low + high) / 2;
  velocity += soil.angular_velocity * Point(-arm.y(), arm.x());
  if (soil.bending_velocity != 0)
    velocity += soil.bending_velocity * bending_velocity(soil, density, low, high, position);
  return velocity;
}

}  // namespace porosph
