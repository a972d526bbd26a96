#include "solver/sph/consistent/consistent.hpp"
#include "solver/sph/paper/paper.hpp"

namespace porosph {

std::unique_ptr<Dynamics> make_dynamics(const FormulationCase& formulation, Model& model) {
  if (formulation.motion == Motion::consistent)
    return std::make_unique<ConsistentDynamics>(formulation, model);
  return std::make_unique<PaperDynamics>(formulation, model);
}

}  // namespace porosph
