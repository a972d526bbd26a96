// Outlines that several tests of the geometry share.
#pragma once

#include "solver/case/case.hpp"

namespace porosph {

inline Polygon rectangle(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

/// The paper's embankment on its foundation, with the measures that docs and cases use.
inline Polygon embankment() {
  return {{0, 0}, {44.4, 0}, {44.4, 6}, {33, 6}, {20.5, 11}, {15, 11}, {10, 6}, {0, 6}};
}

inline Case scene_of(const std::vector<Polygon>& polygons, double spacing,
                     Arrangement arrangement = Arrangement::lattice) {
  Case scene;
  scene.particles.spacing = spacing;
  scene.particles.arrangement = arrangement;
  for (const Polygon& polygon : polygons) {
    scene.soils.emplace_back().polygon = polygon;
    scene.soils.back().name = "soil " + std::to_string(scene.soils.size());
  }
  return scene;
}

}  // namespace porosph
