#include "solver/water/still_water.hpp"

namespace porosph {
namespace {

bool is_everywhere(const std::vector<WaterStretch>& stretches) {
  return stretches.size() == 1 && stretches[0].x_from == -never && stretches[0].x_to == never;
}

/// One level over all, so that the loop becomes vector code.
void follow_level(double level, double unit_weight, Particles& p, std::size_t first, std::size_t last) {
  const double* x = p.position.data()->data();
  double* pressure = p.pore_pressure.data();
#pragma omp simd
  for (std::size_t i = first; i < last; ++i) {
    const double depth = level - x[2 * i + 1];
    pressure[i] = depth > 0 ? -unit_weight * depth : -0.0;
  }
}

}  // namespace

void StillWater::follow(const StandingWater& standing, Particles& p, std::size_t first,
                        std::size_t last) const {
  if (is_everywhere(standing.stretches()))
    return follow_level(standing.stretches()[0].level, standing.unit_weight(), p, first, last);
  for (std::size_t i = first; i < last; ++i)
    p.pore_pressure[i] = standing.pore_pressure(p.position[i].x(), p.position[i].y());
}

/// As the wall sees the pressure: hydrostatic on through it, but where the level passes between a particle
/// and its image, p_w has a kink there that the image must not move. The mean of both is then p_w at the
/// wall.
void StillWater::fill_ghosts(const StandingWater& standing, const Particles& p, const Ghosts& ghosts,
                             std::span<const Vec2> places, std::span<double> pressure) const {
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    const Vec2& root = p.position[ghosts.root(i)];
    const double at_root = standing.depth(root.x(), root.y());
    const double at_image = standing.depth(root.x(), places[i].y());
    double& here = pressure[p.size() + i] = standing.pore_pressure(root.x(), places[i].y());
    if ((at_root > 0) != (at_image > 0))
      here = 2 * standing.pore_pressure(root.x(), 0.5 * (root.y() + places[i].y())) -
             standing.pore_pressure(root.x(), root.y());
  }
}

}  // namespace porosph
