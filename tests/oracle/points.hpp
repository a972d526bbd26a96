// The points that sums run over: particles and their images behind the walls.
#pragma once

#include <vector>

#include "solver/boundary/wall.hpp"
#include "solver/model/model.hpp"

namespace porosph::oracle {

/// A particle, seen in no wall, in one, or (at corners) in several, one after the other.
struct SeenParticle {
  std::size_t particle = 0;
  std::vector<const Wall*> walls;

  bool real() const { return walls.empty(); }
};

/// Householder's reflection at the wall's direction.
Mat2 reflection(const Wall& wall);

Vec2 place_behind(const std::vector<const Wall*>& walls, Vec2 position);
/// R with place_behind(x) - place_behind(y) = R (x - y).
Mat2 turn_behind(const std::vector<const Wall*>& walls);
/// How velocities and displacements appear behind the walls: mirrored by rollers, reversed by fixed walls.
Mat2 motion_behind(const std::vector<const Wall*>& walls);

/// All particles at `positions`, then all their images, each wall mirroring what those before it made.
std::vector<SeenParticle> all_points(const std::vector<Wall>& walls, const std::vector<Vec2>& positions);

/// W of eq. (2) [1/m2] and its gradient with respect to `apart` = x_a - x_b, eq. (5) [1/m3].
double kernel(const Vec2& apart, double h);
Vec2 kernel_gradient(const Vec2& apart, double h);

}  // namespace porosph::oracle
