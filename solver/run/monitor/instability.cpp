#include "solver/run/monitor/instability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "solver/run/monitor/energy.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {
namespace {

/// As many digits as tell particles apart, however far from the origin [m].
std::string metres(const Model& model, double x) {
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(model.spacing)))) + 2;
  return fmt::format("{:.{}f}", x, decimals);
}

std::string place(const Model& model, const Vec2& position) {
  const Vec2 x = position + model.origin;
  return fmt::format("({}, {}) m", metres(model, x.x()), metres(model, x.y()));
}

std::string name_of(const Model& model, std::size_t i) {
  const Vec2 start = model.particles.start[i] + model.origin;
  return fmt::format("particle {} (from x = {} m, y = {} m)", model.particles.id[i], metres(model, start.x()),
                     metres(model, start.y()));
}

bool finite(const Stress& s) { return std::isfinite(s.xx + s.yy + s.zz + s.xy); }

}  // namespace

std::string_view cause_name(Cause cause) {
  static constexpr std::array<std::string_view, 8> names = {"not finite",  "too fast",   "inverted",
                                                            "energy gain", "separated",  "beyond a wall",
                                                            "too stiff",   "not at rest"};
  return names[static_cast<std::size_t>(cause)];
}

std::optional<Breakdown> find_runaway(const Model& model, double time) {
  const Particles& p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!p.velocity[i].allFinite() || !p.position[i].allFinite() || !finite(p.stress[i]) ||
        !std::isfinite(p.density[i]))
      return Breakdown{
          Cause::not_finite, time,
          fmt::format("at {:.6g} s {} is no longer finite; {}", time, name_of(model, i), model.usual_cause)};
    if (!(p.density[i] > 0))
      return Breakdown{Cause::inverted, time,
                       fmt::format("at {:.6g} s the soil around {} is turned inside out (its volume is not "
                                   "positive), at {}; {}",
                                   time, name_of(model, i), place(model, p.position[i]), model.usual_cause)};
    if (p.velocity[i].norm() > model.wave_speed)
      return Breakdown{
          Cause::too_fast, time,
          fmt::format("at {:.6g} s {} moves at {:.4g} m/s, faster than the compression wave ({:.4g} m/s); {}",
                      time, name_of(model, i), p.velocity[i].norm(), model.wave_speed, model.usual_cause)};
  }
  return std::nullopt;
}

Bodies find_bodies(std::span<const Vec2> positions, double support) {
  const NeighbourList near = find_neighbours(positions, positions.size(), support);
  Bodies bodies;
  bodies.body.assign(positions.size(), -1);
  std::vector<std::int32_t> open;
  for (std::size_t seed = 0; seed < positions.size(); ++seed) {
    if (bodies.body[seed] >= 0) continue;
    const auto number = static_cast<std::int32_t>(bodies.count++);
    bodies.body[seed] = number;
    open.push_back(static_cast<std::int32_t>(seed));
    while (!open.empty()) {
      const std::int32_t a = open.back();
      open.pop_back();
      for (std::int32_t b : near.of(a)) {
        if (bodies.body[b] >= 0) continue;
        bodies.body[b] = number;
        open.push_back(b);
      }
    }
  }
  return bodies;
}

std::optional<Breakdown> find_separation(const Model& model, std::int64_t bodies_at_start, double time) {
  const Particles& p = model.particles;
  const Bodies bodies = find_bodies(p.position, 2 * model.smoothing_length);
  if (bodies.count <= bodies_at_start) return std::nullopt;
  std::vector<std::int64_t> size(bodies.count, 0);
  for (std::int32_t b : bodies.body) ++size[b];
  std::vector<std::int32_t> order(bodies.count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return size[a] > size[b]; });
  const std::int32_t thrown = order[bodies_at_start];
  const auto first = static_cast<std::size_t>(std::find(bodies.body.begin(), bodies.body.end(), thrown) -
                                              bodies.body.begin());
  return Breakdown{Cause::separated, time,
                   fmt::format("at {:.6g} s {} and {} more have left the soil body, at {}; {}", time,
                               name_of(model, first), size[thrown] - 1, place(model, p.position[first]),
                               model.usual_cause)};
}

std::optional<Breakdown> find_too_stiff(const Model& model, double time) {
  const Particles& p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Soil& soil = model.soils[p.soil[i]];
    const double share = soil.stiffness(p, i) / soil.constrained_modulus();
    if (share > 1 + 1e-9)
      return Breakdown{
          Cause::too_stiff, time,
          fmt::format("at {:.6g} s {} is {:.3g} times as stiff as youngs_modulus of its soil allows, at "
                      "{}: the time step is for that; give the soil a larger one",
                      time, name_of(model, i), share, place(model, p.position[i]))};
  }
  return std::nullopt;
}

double closest_distance(std::span<const Vec2> positions, double radius) {
  const NeighbourList near = find_neighbours(positions, positions.size(), radius);
  double closest = radius;
  for (std::size_t a = 0; a < positions.size(); ++a)
    for (std::int32_t b : near.of(a)) closest = std::min(closest, (positions[a] - positions[b]).norm());
  return closest;
}

std::optional<Breakdown> find_beyond_wall(const Model& model, double time) {
  const Particles& p = model.particles;
  for (const Wall& wall : model.walls) {
    if (wall.is_periodic()) continue;
    const Vec2 along = (wall.to - wall.from).normalized();
    const double length = (wall.to - wall.from).norm();
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double before = (p.start[i] - wall.from).dot(along), now = (p.position[i] - wall.from).dot(along);
      const bool beside = before < 0 || before > length || now < 0 || now > length;
      if (beside || wall.distance(p.start[i]) <= 0 || wall.distance(p.position[i]) > -0.25 * model.spacing)
        continue;
      return Breakdown{Cause::beyond_wall, time,
                       fmt::format("at {:.6g} s {} is at {}, behind the boundary from {} to {}; {}", time,
                                   name_of(model, i), place(model, p.position[i]), place(model, wall.from),
                                   place(model, wall.to), model.usual_cause)};
    }
  }
  return std::nullopt;
}

std::optional<Breakdown> find_crossing(const Model& model, double allowed, double time) {
  const Particles& p = model.particles;
  const NeighbourList near = find_neighbours(p.position, p.size(), allowed);
  for (std::size_t a = 0; a < p.size(); ++a)
    for (std::int32_t b : near.of(a))
      return Breakdown{
          Cause::inverted, time,
          fmt::format("at {:.6g} s {} and particle {} met at {}: the soil between them is turned "
                      "inside out; {}",
                      time, name_of(model, a), p.id[b], place(model, p.position[a]), model.usual_cause)};
  return std::nullopt;
}

Breakdown energy_gain(const Model& model, std::span<const Vec2> velocities, double gained, double time) {
  const Particles& p = model.particles;
  std::size_t most = 0;
  double largest = -1;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double energy = 0.5 * p.mass[i] * velocities[i].squaredNorm() + elastic_energy(model, i);
    if (energy > largest) largest = energy, most = i;
  }
  return {Cause::energy_gain, time,
          fmt::format("at {:.6g} s {:.0f} % of the energy in motion and strain came from nowhere, most of it "
                      "at {}, now at {}; {}",
                      time, 100 * gained, name_of(model, most), place(model, p.position[most]),
                      model.usual_cause)};
}

}  // namespace porosph
