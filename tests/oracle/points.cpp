#include "tests/oracle/points.hpp"

#include <cmath>
#include <numbers>

namespace porosph::oracle {

Mat2 reflection(const Wall& wall) {
  const Vec2 t = (wall.to - wall.from).normalized();
  return 2 * t * t.transpose() - Mat2::Identity();
}

Vec2 place_behind(const std::vector<const Wall*>& walls, Vec2 position) {
  for (const Wall* wall : walls) position = wall->from + reflection(*wall) * (position - wall->from);
  return position;
}

Mat2 turn_behind(const std::vector<const Wall*>& walls) {
  Mat2 turn = Mat2::Identity();
  for (const Wall* wall : walls) turn = reflection(*wall) * turn;
  return turn;
}

Mat2 motion_behind(const std::vector<const Wall*>& walls) {
  Mat2 motion = Mat2::Identity();
  for (const Wall* wall : walls)
    motion = wall->kind == BoundaryKind::fixed ? Mat2(-motion) : Mat2(reflection(*wall) * motion);
  return motion;
}

std::vector<SeenParticle> all_points(const std::vector<Wall>& walls, const std::vector<Vec2>& positions) {
  std::vector<SeenParticle> points;
  for (std::size_t a = 0; a < positions.size(); ++a) points.push_back({a, {}});
  for (const Wall& wall : walls) {
    const std::size_t before = points.size();
    for (std::size_t i = 0; i < before; ++i) {
      SeenParticle image = points[i];
      if ((place_behind(image.walls, positions[image.particle]) - wall.from).dot(wall.normal) <= 0) continue;
      image.walls.push_back(&wall);
      points.push_back(image);
    }
  }
  return points;
}

double kernel(const Vec2& apart, double h) {
  const double alpha = 10 / (7 * std::numbers::pi * h * h), q = apart.norm() / h;
  if (q < 1) return alpha * (1 - 3. / 2 * std::pow(q, 2) + 3. / 4 * std::pow(q, 3));
  if (q < 2) return alpha * (1. / 4 * std::pow(2 - q, 3));
  return 0;
}

Vec2 kernel_gradient(const Vec2& apart, double h) {
  const double alpha = 10 / (7 * std::numbers::pi * h * h), q = apart.norm() / h;
  double derivative = 0;  // dW/dq
  if (q < 1)
    derivative = alpha * (-3 * q + 9. / 4 * std::pow(q, 2));
  else if (q < 2)
    derivative = alpha * (-3. / 4 * std::pow(2 - q, 2));
  return derivative / h * apart.normalized();
}

}  // namespace porosph::oracle
