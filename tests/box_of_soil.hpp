// A rectangular box of soil: the scene that most tests start from.
#pragma once

#include <random>
#include <string>

#include "solver/case/case.hpp"
#include "solver/model/model.hpp"

namespace porosph {

inline Polygon box_outline(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

/// The paper's soil, in `columns` x `rows` cells of `spacing` [m] from the origin; dry, free on all sides,
/// under gravity.
inline Case box_of_soil(int columns, int rows, double spacing = 0.5) {
  Case scene;
  scene.title = "box of soil";
  scene.particles.spacing = spacing;
  scene.soils.push_back({.name = "soil",
                         .polygon = box_outline(0, 0, columns * spacing, rows * spacing),
                         .holes = {},
                         .youngs_modulus = 15e6,
                         .poissons_ratio = 0.33,
                         .unit_weight_saturated = 20e3,
                         .unit_weight_unsaturated = 18.6e3});
  scene.time.end = 1;
  return scene;
}

inline void add_wall(Case& scene, BoundaryKind kind, Point from, Point to) {
  scene.boundaries.push_back({.kind = kind, .from = from, .to = to, .coefficient = 0});
}

/// Water at rest everywhere, up to `level` [m].
inline void add_water(Case& scene, double level) { scene.water.stretches.push_back({.level = level}); }

/// Rollers at both sides of the box and a wall below it.
inline void hold_as_column(Case& scene, BoundaryKind bottom = BoundaryKind::fixed) {
  const Polygon box = scene.soils.front().polygon;
  const double top = scene.soils.back().polygon[2].y();
  add_wall(scene, bottom, box[0], box[1]);
  add_wall(scene, BoundaryKind::roller, box[0], {box[0].x(), top});
  add_wall(scene, BoundaryKind::roller, box[1], {box[1].x(), top});
}

/// Numbers between -1 and 1, the same on every machine.
class Noise {
 public:
  explicit Noise(unsigned seed) : generator_(seed) {}
  double operator()() { return 2 * (static_cast<double>(generator_()) / 4294967296.0) - 1; }
  Vec2 vector() {
    const double x = (*this)();
    return {x, (*this)()};
  }

 private:
  std::mt19937 generator_;
};

}  // namespace porosph
