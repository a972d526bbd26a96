// Cases for the tests of meshes and files of the finite-element reference.
#pragma once

#include "solver/case/case_file.hpp"

namespace porosph::test {

/// The embankment as it is shipped.
inline Case embankment() { return read_case(POROSPH_SOURCE_DIR "/cases/embankment.toml"); }

/// A layered column 4 m wide and 6 m high: clay of 2 m below sand, around a square hole if wanted.
inline Case layers(bool hole) {
  Case scene;
  SoilCase clay, sand;
  clay.name = "clay";
  clay.polygon = {{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  clay.youngs_modulus = 5e6;
  clay.poissons_ratio = 0.4;
  clay.unit_weight_saturated = clay.unit_weight_unsaturated = 18e3;
  sand.name = "sand";
  sand.polygon = {{0, 2}, {4, 2}, {4, 6}, {0, 6}};
  if (hole) sand.holes = {{{1.5, 3}, {2.5, 3}, {2.5, 4}, {1.5, 4}}};
  sand.youngs_modulus = 30e6;
  sand.poissons_ratio = 0.2;
  sand.unit_weight_saturated = 21e3;
  sand.unit_weight_unsaturated = 17e3;
  scene.soils = {clay, sand};
  scene.water.stretches = {{-never, never, 5}};
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, 6}},
                      {BoundaryKind::roller, {4, 0}, {4, 6}},
                      {BoundaryKind::fixed, {0, 0}, {4, 0}}};
  return scene;
}

}  // namespace porosph::test
