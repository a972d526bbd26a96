// A level layer on a base, between periodic sides.
#pragma once

#include "solver/case/case_file.hpp"
#include "tests/box_of_soil.hpp"

namespace porosph {

/// `columns` x `rows` cells of 0.5 m; the base is the first boundary. Dry.
inline Case periodic_strip(int columns, int rows) {
  Case scene = box_of_soil(columns, rows);
  const Polygon box = scene.soils[0].polygon;
  scene.soils[0].unit_weight_unsaturated = scene.soils[0].unit_weight_saturated;
  add_wall(scene, BoundaryKind::fixed, box[0], box[1]);
  add_wall(scene, BoundaryKind::periodic, box[0], box[3]);
  add_wall(scene, BoundaryKind::periodic, box[1], box[2]);
  scene.particles.arrangement = Arrangement::lattice;
  scene.particles.smoothing_ratio = 1.2;
  scene.formulation = default_formulation(Motion::consistent);
  return scene;
}

}  // namespace porosph
