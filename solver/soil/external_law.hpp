// A soil law of one's own, in a program outside these sources.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/particles/field.hpp"
#include "solver/soil/elasticity.hpp"

namespace porosph {

/// The particles of one soil within a tile, and the step that the law carries them over.
struct SoilTile {
  std::int32_t count;                ///< particles
  double dt;                         ///< [s]
  const double* gradient[4];         ///< dv/dx at the middle of the step, xx, xy, yx, yy [1/s]
  double* stress;                    ///< effective, four numbers each: xx, yy, zz, xy; to be replaced [Pa]
  std::span<double* const> history;  ///< of each of the law's history fields: count numbers
};

/// Called once per step for each tile of up to 128 of its particles, from several threads at a time for
/// different tiles. E and nu of the soil set the time step and the bulk viscosity: no stiffness may exceed
/// theirs.
class ExternalLaw {
 public:
  explicit ExternalLaw(const Elasticity& elastic) : elastic_(elastic) {}
  virtual ~ExternalLaw() = default;

  const Elasticity& elastic() const { return elastic_; }
  /// What the law remembers of each particle, 0 at the start.
  virtual std::vector<Field> history() const { return {}; }
  /// Carries stress and history over the step.
  virtual void step(const SoilTile& tile) const = 0;

 private:
  Elasticity elastic_;
};

}  // namespace porosph
