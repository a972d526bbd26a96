#include "solver/sph/consistent/body_contact.hpp"

#include <algorithm>
#include <numeric>

#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {

std::vector<std::int32_t> bodies_of_soils(const Model& model, double range) {
  const Particles& p = model.particles;
  if (model.soils.size() < 2 || std::ranges::any_of(model.soils, &Soil::flows)) return {};
  std::vector<std::int32_t> body(model.soils.size());
  std::iota(body.begin(), body.end(), 0);
  const NeighbourList near = find_neighbours(p.start, p.size(), range);
  for (std::size_t a = 0; a < p.size(); ++a)
    for (const std::int32_t b : near.of(a)) {
      const std::int32_t of_a = body[p.soil[a]], of_b = body[p.soil[b]];
      if (of_a != of_b) std::ranges::replace(body, std::max(of_a, of_b), std::min(of_a, of_b));
    }
  if (std::ranges::all_of(body, [](std::int32_t number) { return number == 0; })) return {};
  return body;
}

void add_contact(const Model& model, std::span<const std::pair<std::int32_t, std::int32_t>> strangers,
                 std::span<Vec2> accelerations) {
  constexpr double share = 0.25;
  const Particles& p = model.particles;
  for (const auto& [a, b] : strangers) {
    const Vec2 apart = p.position[a] - p.position[b];
    const double r = apart.norm();
    if (r >= model.spacing || r == 0) continue;
    const double modulus =
        std::min(model.soils[p.soil[a]].constrained_modulus(), model.soils[p.soil[b]].constrained_modulus());
    const Vec2 force = share * modulus * (model.spacing - r) / r * apart;
    accelerations[a] += force / p.mass[a];
    accelerations[b] -= force / p.mass[b];
  }
}

}  // namespace porosph
