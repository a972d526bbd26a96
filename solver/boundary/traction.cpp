#include "solver/boundary/traction.hpp"

#include <algorithm>

#include "solver/case/shapes.hpp"

namespace porosph {

double factor_at(const std::vector<Point>& over_time, double time) {
  if (over_time.empty()) return 1;
  const auto next = std::ranges::find_if(over_time, [time](const Point& p) { return p.x() > time; });
  if (next == over_time.begin()) return next->y();
  const Point before = *(next - 1);
  if (next == over_time.end()) return before.y();
  return before.y() + (next->y() - before.y()) * (time - before.x()) / (next->x() - before.x());
}

Vec2 outward_normal(const Case& scene, const Point& from, const Point& to) {
  const Vec2 way = to - from, normal = Vec2(way.y(), -way.x()).normalized();
  const Vec2 beside = (from + to) / 2 + 1e-3 * scene.particles.spacing * normal;
  const bool in_soil =
      std::ranges::any_of(scene.soils, [&](const SoilCase& s) { return distance(beside, s) == 0; });
  return in_soil ? Vec2(-normal) : normal;
}

LoadCase at_rest_from(LoadCase load, double time) {
  const double factor = factor_at(load.over_time, time);
  load.pressure *= factor, load.pressure_to *= factor;
  load.traction *= factor, load.traction_to *= factor;
  load.over_time.clear();
  return load;
}

FootingCase at_rest_from(FootingCase footing, double time) {
  double& driven = footing.force < never ? footing.force : footing.settlement;
  driven *= factor_at(footing.over_time, time);
  footing.over_time.clear();
  return footing;
}

Vec2 Traction::traction(const Vec2& place, const Vec2& normal, double time) const {
  const Vec2 way = load_.to - load_.from;
  const double t = std::clamp((place - load_.from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  const double pressure = load_.pressure + t * (load_.pressure_to - load_.pressure);
  const Vec2 traction = load_.traction + t * (load_.traction_to - load_.traction);
  return factor_at(load_.over_time, time) * (traction - pressure * normal);
}

}  // namespace porosph
