#include "solver/sph/consistent/loose_particles.hpp"

#include <algorithm>
#include <cmath>

namespace porosph {

void LooseParticles::take(const Model& model, std::span<const std::int32_t> neighbours,
                          std::span<const std::uint8_t> at_walls, bool flows) {
  const double reach = model.smoothing_length / (1.2 * model.spacing);
  const int fewest =
      std::min(fewest_neighbours, static_cast<int>(std::lround(fewest_neighbours * reach * reach)));
  bears_.assign(neighbours.size(), 1);
  walls_.clear();
  flows_ = flows;
  for (std::size_t a = 0; flows && a < neighbours.size(); ++a) {
    const Soil& soil = model.soils[model.particles.soil[a]];
    if (!soil.flows()) continue;
    const bool loose = neighbours[a] < fewest && !soil.stiffness_varies();
    if (loose) bears_[a] = 0;
    if (loose || at_walls[a])
      walls_.watch(static_cast<std::int32_t>(a), (loose ? loose_ends : body_ends) * model.spacing);
  }
}

}  // namespace porosph
