// The reference configuration of the consistent form: points, ghosts, kernel gradients and their corrections.
#pragma once

#include <vector>

#include "solver/boundary/ghosts.hpp"
#include "solver/case/case.hpp"
#include "solver/model/model.hpp"
#include "solver/sph/consistent/pair_stencils.hpp"
#include "solver/sph/consistent/plane_tensors.hpp"
#include "solver/sph/consistent/surroundings.hpp"
#include "solver/sph/kernels/consistent_kernels.hpp"

namespace porosph {

/// Arrays are of the particles, then the ghosts, where no other is said.
struct ReferenceConfiguration {
  std::vector<Vec2> points;  ///< [m]
  Ghosts ghosts;
  std::vector<double> volume;        ///< of whole cells [m2]
  std::vector<double> density;       ///< of the particles [kg/m3]
  PairStencils stencils;             ///< of the particles
  PlaneTensors correction;           ///< L of eq. (10)
  PlaneVectors kappa;                ///< of closed gradients [m]; empty where they are closed without
  std::vector<std::uint8_t> listed;  ///< 1 where an own list names it

  bool made() const { return !points.empty(); }
  bool closed() const { return !kappa.empty(); }
  std::size_t particles() const { return density.size(); }
  ReferenceView view(const Particles& particles);
};

/// That of the particles where they are now, from what they see there.
ReferenceConfiguration make_reference(const Model& model, const FormulationCase& formulation,
                                      SeenNeighbours seen);

}  // namespace porosph
