#include "solver/run/energy_budget.hpp"

#include <algorithm>

#include "solver/sph/consistent/flowing_soil.hpp"

namespace porosph {

std::optional<Summary::EnergyBudget> energy_budget(Simulation& simulation, double at_start) {
  const FlowingSoil* flow = simulation.dynamics().flow();
  const LoadingCase& loading = simulation.scene().loading;
  if (flow == nullptr || !simulation.scene().footings.empty() || loading.adaptive_damping ||
      loading.damping > 0 || std::ranges::any_of(simulation.model().soils, &Soil::stiffness_varies))
    return std::nullopt;
  const Simulation::Energy now = simulation.energy();
  const FlowingSoil::Work& work = flow->work();
  Summary::EnergyBudget budget{.released = -(now.gravity + now.water) + work.shift,
                               .kinetic = now.kinetic,
                               .elastic = now.elastic - at_start,
                               .plastic = work.plastic,
                               .control = work.control,
                               .contact = flow->loose().walls().work(),
                               .walls = flow->wall_work().work(),
                               .diffusion = work.diffusion,
                               .bulk_viscosity = work.viscous};
  budget.unaccounted = budget.released - budget.kinetic - budget.elastic - budget.plastic - budget.control -
                       budget.contact - budget.walls - budget.diffusion - budget.bulk_viscosity;
  return budget;
}

}  // namespace porosph
