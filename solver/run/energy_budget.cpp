#include "solver/run/energy_budget.hpp"

#include "solver/sph/consistent/flowing_soil.hpp"

namespace porosph {

std::optional<Summary::EnergyBudget> energy_budget(Simulation& simulation, double at_start) {
  const FlowingSoil* flow = simulation.dynamics().flow();
  const LoadingCase& loading = simulation.scene().loading;
  if (flow == nullptr || simulation.follows_flow() || !simulation.scene().footings.empty() ||
      loading.adaptive_damping || loading.damping > 0)
    return std::nullopt;
  const Simulation::Energy now = simulation.energy();
  const FlowingSoil::Work& work = flow->work();
  // Steps count the energy of the largest moduli, by which alone the law's dissipation would be too large.
  const double beyond = energy_beyond_linear(simulation.model()) - work.beyond_linear_at_start;
  Summary::EnergyBudget budget{.released = -(now.gravity + now.water) + work.shift,
                               .kinetic = now.kinetic,
                               .elastic = now.elastic - at_start + beyond,
                               .plastic = work.plastic - beyond,
                               .control = work.control,
                               .contact = flow->loose().walls().work(),
                               .friction = simulation.dynamics().work_of_wall_friction(),
                               .diffusion = work.diffusion,
                               .bulk_viscosity = work.viscous};
  const DynamicWater* water = simulation.water_in_motion();
  if (water != nullptr) budget.released += water->energy(), budget.water = water->taken();
  budget.walls = flow->wall_work().work() - budget.friction;
  budget.unaccounted = budget.released - budget.kinetic - budget.elastic - budget.plastic - budget.control -
                       budget.contact - budget.friction - budget.walls - budget.diffusion -
                       budget.bulk_viscosity - budget.water;
  return budget;
}

}  // namespace porosph
