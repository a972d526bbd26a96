// The K0 method: right for level ground and level layers, a first guess elsewhere.
#include <algorithm>

#include "solver/model/model.hpp"

namespace porosph {
namespace {

/// Heights at which the vertical line through x crosses the outline, in increasing order.
std::vector<double> crossings(const Polygon& outline, double x) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point& a = outline[i];
    const Point& b = outline[(i + 1) % outline.size()];
    if ((a.x() <= x) == (b.x() <= x)) continue;
    heights.push_back(a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

struct Overburden {
  double weight = 0;    // of soil with the water in it [Pa]
  double top = -never;  // highest soil above the point [m]
};

void add_soil(const SoilCase& soil, const StandingWater& water, const Point& p, Overburden& sum) {
  std::vector<double> heights = crossings(soil.polygon, p.x());
  for (const Polygon& hole : soil.holes)
    for (double y : crossings(hole, p.x())) heights.push_back(y);
  std::sort(heights.begin(), heights.end());
  for (std::size_t i = 0; i + 1 < heights.size(); i += 2) {
    const double low = std::max(heights[i], p.y()), high = heights[i + 1];
    if (high <= low) continue;
    const double wet = std::clamp(water.depth(p.x(), low), 0.0, high - low);
    sum.weight += wet * soil.unit_weight_saturated + (high - low - wet) * soil.unit_weight_unsaturated;
    sum.top = std::max(sum.top, high);
  }
}

}  // namespace

Stress k0_stress(const Case& scene, const Point& position, double k0) {
  const StandingWater water(scene.water);
  Overburden sum;
  for (const SoilCase& soil : scene.soils) add_soil(soil, water, position, sum);
  const double free_water = std::max(0.0, water.depth(position.x(), std::max(sum.top, position.y())));
  const double total = -(sum.weight + free_water * water.unit_weight());
  const double vertical = total - water.pore_pressure(position.x(), position.y());
  return {.xx = k0 * vertical, .yy = vertical, .zz = k0 * vertical, .xy = 0};
}

}  // namespace porosph
