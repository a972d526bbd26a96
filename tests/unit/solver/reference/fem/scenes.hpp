// Small cases for the tests of the finite-element reference.
#pragma once

#include "solver/case/case.hpp"

namespace porosph::test {

/// The foundation: 15 m x 10 m, rollers at both sides, fixed bottom, water 5 m above the ground.
inline Case foundation() {
  Case scene;
  SoilCase soil;
  soil.name = "sand";
  soil.polygon = {{0, 0}, {15, 0}, {15, 10}, {0, 10}};
  soil.youngs_modulus = 15e6;
  soil.poissons_ratio = 0.33;
  soil.unit_weight_saturated = 20e3;
  soil.unit_weight_unsaturated = 18e3;
  scene.soils = {soil};
  scene.water.stretches = {{-never, never, 15}};
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, 10}},
                      {BoundaryKind::roller, {15, 0}, {15, 10}},
                      {BoundaryKind::fixed, {0, 0}, {15, 0}}};
  return scene;
}

inline double constrained_modulus(const SoilCase& soil) {
  const double nu = soil.poissons_ratio;
  return soil.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
}

}  // namespace porosph::test
