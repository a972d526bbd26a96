#include "solver/run/hand_over.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "solver/run/recomputed_stress.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {
namespace {

constexpr double same_place = 1e-3;  // of the spacing

/// Number of each soil's name in the other case, -1 where it is not there.
std::vector<int> soils_in(const Case& other, const Case& scene) {
  std::vector<int> places;
  for (const SoilCase& soil : scene.soils) {
    const auto found = std::ranges::find(other.soils, soil.name, &SoilCase::name);
    places.push_back(found == other.soils.end() ? -1 : static_cast<int>(found - other.soils.begin()));
  }
  return places;
}

/// For each particle of the new model the one that was there before, or -1.
std::vector<std::int32_t> find_same(const Case& old_scene, const Particles& old, const Vec2& shift,
                                    const Case& scene, const Model& model) {
  const Particles& p = model.particles;
  std::vector<Vec2> places;
  for (const Vec2& start : old.start) places.emplace_back(start + shift);
  const NeighbourList near = find_neighbours(p.start, places, same_place * model.spacing);
  const std::vector<int> soil_before = soils_in(old_scene, scene);
  std::vector<std::int32_t> same(p.size(), -1);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (const std::int32_t b : near.of(i))
      if (old.soil[b] == soil_before[p.soil[i]]) same[i] = b;
  return same;
}

/// A soil that both cases have is either whole in both, or it is another.
void check_whole(const Case& old_scene, const Particles& old, const Case& scene, const Particles& p,
                 const std::vector<std::int32_t>& same) {
  const std::vector<int> before = soils_in(old_scene, scene);
  for (std::size_t s = 0; s < scene.soils.size(); ++s) {
    if (before[s] < 0) continue;
    const auto count = [](const std::vector<std::int32_t>& soils, std::size_t soil) {
      return std::ranges::count(soils, static_cast<std::int32_t>(soil));
    };
    std::int64_t found = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      found += p.soil[i] == static_cast<std::int32_t>(s) && same[i] >= 0 ? 1 : 0;
    const auto now = count(p.soil, s), then = count(old.soil, before[s]);
    if (found == now && now == then) continue;
    throw std::runtime_error(fmt::format(
        "soil '{}' does not fit the state to start from: of its {} particles {} are where the {} of "
        "that state were drawn; outline, particles.spacing and particles.arrangement must be the "
        "same, or the soil must have another name",
        scene.soils[s].name, now, found, then));
  }
}

void copy_state(const Particles& old, std::size_t b, const Vec2& shift, Particles& p, std::size_t i) {
  p.position[i] = old.position[b] + shift;
  p.velocity[i] = old.velocity[b];
  p.stress[i] = old.stress[b];
  p.density[i] = old.density[b];
  p.mass[i] = old.mass[b];
  if (!p.interface_stress.empty() && !old.interface_stress.empty())
    p.interface_stress[i] = old.interface_stress[b];
}

const HistoryField* find_history(const Particles& p, std::string_view name) {
  const auto found = std::ranges::find_if(p.history, [&](const auto& h) { return h.field.name == name; });
  return found == p.history.end() ? nullptr : &*found;
}

/// `drawn`, `old_drawn`: as the cases give them, in the same order as the particles.
class TakeOver {
 public:
  TakeOver(const HandedOver& from, const Particles& old_drawn, Model& model,
           const std::vector<std::int32_t>& same)
      : from_(from.particles),
        old_drawn_(old_drawn),
        drawn_(model.particles),
        model_(model),
        same_(same),
        shift_(from.origin - model.origin) {}

  void take() {
    Particles& p = model_.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (same_[i] >= 0) take(p, i, same_[i]);
    place_new(p);
  }

 private:
  void take(Particles& p, std::size_t i, std::size_t b) {
    copy_state(from_, b, shift_, p, i);
    if (const double change = drawn_.mass[i] / old_drawn_.mass[b]; change != 1)  // of weight: of water, say
      p.mass[i] *= change, p.density[i] *= change;
    for (HistoryField& h : p.history) {
      const HistoryField* before = find_history(from_, h.field.name);
      const HistoryField* at_start = find_history(old_drawn_, h.field.name);
      const bool same_at_start = before != nullptr && at_start->values[b] == h.values[i];
      if (same_at_start) h.values[i] = before->values[b];
    }
  }

  /// Where the ground near them has gone: row by row, each moves as the mean of what is in reach below it.
  void place_new(Particles& p) {
    std::vector<char> placed(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) placed[i] = same_[i] >= 0;
    if (std::ranges::count(placed, 1) == std::ssize(placed)) return;
    if (p.uncounted.empty()) p.uncounted.assign(p.size(), Vec2::Zero());
    while (place_next(p, placed)) {
    }
  }

  bool place_next(Particles& p, std::vector<char>& placed) {
    const double reach = 2 * model_.smoothing_length;
    std::vector<std::int32_t> waiting, there;
    std::vector<Vec2> waiting_at, there_at;
    for (std::size_t i = 0; i < p.size(); ++i) {
      (placed[i] ? there : waiting).push_back(static_cast<std::int32_t>(i));
      (placed[i] ? there_at : waiting_at).push_back(p.start[i]);
    }
    const NeighbourList near = find_neighbours(waiting_at, there_at, reach);
    bool any = false;
    for (std::size_t k = 0; k < waiting.size(); ++k) {
      Vec2 sum = Vec2::Zero();
      double weights = 0;
      for (const std::int32_t j : near.of(k)) {
        const std::int32_t b = there[j];
        const double weight = std::pow(1 - (there_at[j] - waiting_at[k]).norm() / reach, 2);
        sum += weight * (p.position[b] - p.start[b]), weights += weight;
      }
      if (weights == 0) continue;
      const std::int32_t i = waiting[k];
      p.uncounted[i] = sum / weights, p.position[i] += p.uncounted[i];
      placed[i] = any = true;
    }
    return any;
  }

  const Particles &from_, &old_drawn_;
  const Particles drawn_;
  Model& model_;
  const std::vector<std::int32_t>& same_;
  Vec2 shift_;
};

void count_from_here(Particles& p) {
  p.uncounted.resize(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) p.uncounted[i] = p.position[i] - p.start[i];
}

}  // namespace

void take_over(const Beginning& beginning, const Case& scene, Model& model) {
  if (beginning.state == nullptr) return;
  const HandedOver& from = *beginning.state;
  const Model drawn_before = build_model(from.scene);
  Particles& p = model.particles;
  const std::vector<std::int32_t> same =
      find_same(from.scene, from.particles, from.origin - model.origin, scene, model);
  check_whole(from.scene, from.particles, scene, p, same);
  if (!from.particles.uncounted.empty()) {
    p.uncounted.assign(p.size(), Vec2::Zero());
    for (std::size_t i = 0; i < p.size(); ++i)
      if (same[i] >= 0) p.uncounted[i] = from.particles.uncounted[same[i]];
  }
  const bool all_were_there = std::ranges::none_of(same, [](std::int32_t b) { return b < 0; });
  const bool recomputes = all_were_there && displacement_is_strain(from.scene, scene);
  const std::optional<Model> drawn = recomputes ? std::optional(model) : std::nullopt;
  TakeOver(from, drawn_before.particles, model, same).take();
  if (recomputes) recompute_stress(from, drawn_before, *drawn, same, p);
  if (beginning.reset_displacements) count_from_here(p);
  model.water.set_time(beginning.time);
  if (model.pore_water->acts(model.water)) model.pore_water->follow(model.water, p, 0, p.size());
}

}  // namespace porosph
