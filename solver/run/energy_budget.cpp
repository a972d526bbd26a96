#include "solver/run/energy_budget.hpp"

#include "solver/sph/consistent/flowing_soil.hpp"

namespace porosph {
namespace {

using Budget = Summary::EnergyBudget;
constexpr double Budget::*spent[] = {
    &Budget::kinetic,  &Budget::elastic, &Budget::plastic,   &Budget::control,        &Budget::contact,
    &Budget::friction, &Budget::walls,   &Budget::diffusion, &Budget::bulk_viscosity, &Budget::water};

bool is_counted(const Simulation& s) {
  const LoadingCase& loading = s.scene().loading;
  const bool in_drained_flow = s.follows_flow() && s.water_in_motion() == nullptr;
  return s.dynamics().flow() != nullptr && !in_drained_flow && s.scene().footings.empty() &&
         s.scene().sheets.empty() && !loading.adaptive_damping && loading.damping == 0;
}

}  // namespace

Summary::EnergyBudget energy_counts(Simulation& s) {
  const Simulation::Energy now = s.energy();
  const FlowingSoil* flow = s.dynamics().flow();
  const FlowingSoil::Work& work = flow->work();
  // Steps count the energy of the largest moduli, by which alone the law's dissipation would be too large.
  const double beyond = energy_beyond_linear(s.model()) - work.beyond_linear_at_start;
  Budget counts{.released = -(now.gravity + now.water) + s.given_by_loads() + s.base().work() + work.shift,
                .kinetic = now.kinetic,
                .elastic = now.elastic + beyond,
                .plastic = work.plastic - beyond,
                .control = work.control,
                .contact = flow->loose().walls().work(),
                .friction = s.dynamics().work_of_wall_friction(),
                .diffusion = work.diffusion,
                .bulk_viscosity = work.viscous};
  const DynamicWater* water = s.water_in_motion();
  if (water != nullptr) counts.released += water->energy(), counts.water = water->taken();
  counts.walls = flow->wall_work().work() - counts.friction;
  return counts;
}

std::optional<Summary::EnergyBudget> energy_budget(Simulation& s, double at_start) {
  if (!is_counted(s)) return std::nullopt;
  Budget budget = energy_counts(s);
  if (const Budget* before = s.energy_when_lost()) {
    budget.released -= before->released;
    for (const auto part : spent) budget.*part -= before->*part;
  } else {
    budget.elastic -= at_start;
  }
  budget.unaccounted = budget.released;
  for (const auto part : spent) budget.unaccounted -= budget.*part;
  return budget;
}

}  // namespace porosph
