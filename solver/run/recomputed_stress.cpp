#include "solver/run/recomputed_stress.hpp"

#include <algorithm>

#include "solver/soil/linear_elastic.hpp"
#include "solver/sph/dynamics.hpp"

namespace porosph {
namespace {

/// The particles of a model as drawn, strained from nothing to these displacements in one step.
Particles strained(const FormulationCase& formulation, Model model, std::span<const Vec2> displacements) {
  Particles& p = model.particles;
  for (Soil& soil : model.soils) soil = Soil(LinearElastic{soil.elastic()});
  std::ranges::fill(p.stress, Stress{});
  std::ranges::fill(p.interface_stress, 0.0);
  std::ranges::fill(p.velocity, Vec2::Zero());
  const auto dynamics = make_dynamics(formulation, model);
  dynamics->prepare();
  std::ranges::copy(displacements, p.velocity.begin());
  dynamics->strain(1);
  return std::move(p);
}

bool is_linear(const SoilCase& soil) { return soil.law == LawKind::elastic && !soil.no_tension; }

}  // namespace

bool displacement_is_strain(const Case& before, const Case& now) {
  const auto holds = [](const Case& c) {
    return c.all_from_start && c.formulation.motion == Motion::consistent &&
           (c.plan ? c.plan->sheets : c.sheets).empty();
  };
  return holds(before) && holds(now);
}

void recompute_stress(const HandedOver& from, const Model& before, const Model& now,
                      std::span<const std::int32_t> same, Particles& particles) {
  std::vector<Vec2> moved_before, moved(same.size(), Vec2::Zero());
  for (std::size_t b = 0; b < from.particles.size(); ++b)
    moved_before.push_back(from.particles.position[b] - from.particles.start[b]);
  for (std::size_t i = 0; i < same.size(); ++i) moved[i] = moved_before[same[i]];
  Model as_before = now;  // its elasticity is that with which the stress came about
  for (std::size_t i = 0; i < same.size(); ++i)
    as_before.soils[now.particles.soil[i]] = before.soils[before.particles.soil[same[i]]];
  const FormulationCase& formulation = from.scene.formulation;
  const Particles old = strained(formulation, before, moved_before),
                  recomputed = strained(formulation, std::move(as_before), moved);
  for (std::size_t i = 0; i < same.size(); ++i) {
    const std::int32_t b = same[i];
    if (!is_linear(from.scene.soils[before.particles.soil[b]])) continue;
    particles.stress[i] = particles.stress[i] + recomputed.stress[i] + old.stress[b] * -1;
    if (!recomputed.interface_stress.empty() && !old.interface_stress.empty())
      particles.interface_stress[i] += recomputed.interface_stress[i] - old.interface_stress[b];
  }
}

}  // namespace porosph
