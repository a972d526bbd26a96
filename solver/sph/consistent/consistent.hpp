// The consistent form: the exact adjoint of the strain rate, on a reference configuration.
#pragma once

#include <optional>

#include "solver/sph/consistent/flowing_soil.hpp"
#include "solver/sph/consistent/fluxes.hpp"
#include "solver/sph/consistent/interface_hold.hpp"
#include "solver/sph/consistent/reference.hpp"
#include "solver/sph/consistent/wall_friction.hpp"
#include "solver/sph/dynamics.hpp"
#include "solver/sph/kernels/consistent_kernels.hpp"
#include "solver/sph/soil_views.hpp"

namespace porosph {

/// b of the viscosity in compression that is used. By default none where soil yields: flowing particles come
/// together and part all the time, and what resists only the one is a pressure on average, the larger the
/// stiffer the soil. It made runout grow by 12 % for ten times the Young's modulus.
double bulk_viscosity_of(const FormulationCase& formulation, const Model& model);

/// Each stress acts with its own correction matrix (Bonet and Lok 1999), so that the forces are the adjoint
/// of the strain-rate operator and conserve momentum and energy:
///
///   rho0_a a_a = sum_b V_b (P_a L_a + P_b L_b) grad W_ab  +  J_a F_a^-T L_a sum_b V_b (p_b - p_a) grad W_ab
///   +  rho0_a g dF_a/dt    = sum_b V_b (v_b - v_a) (x) L_a grad W_ab,       P = J (sigma' + p_e I) F^-T
///
/// In disorder, L_a grad W_ab becomes L_a grad W_ab + (kappa_b - kappa_a) F_ab: see closed_gradients.hpp.
///
/// Kernel gradients, volumes V and densities rho0 belong to a reference configuration: that of the last
/// refresh. F is the deformation since then, so the reference may be old without an error in strain or
/// energy. It is rebuilt when |F - I| exceeds the case's refresh_strain, and when particles come near that
/// were no neighbours.
class ConsistentDynamics final : public Dynamics {
 public:
  ConsistentDynamics(const FormulationCase& formulation, Model& model, VectorUnits units = vector_units());

  void prepare() override;
  void accelerations(std::span<Vec2> out) override;
  void velocity_gradients(std::span<Mat2> out) override;
  void strain(double dt, std::span<const double> volume_rates) override;
  void carry_excess(std::span<const double> excess) override { arrays_.state.excess = excess.data(); }
  void excess_accelerations(std::span<const double> excess, std::span<Vec2> out) override;
  void sliding_rates(std::span<const Vec2> velocities, std::span<Mat2> out) override;
  void volume_rates(std::span<const Mat2> rates, std::span<double> out, double ahead) override;
  void visit(StateArchive& state) override;
  const FlowingSoil* flow() const override { return flow_.active() ? &flow_ : nullptr; }
  double work_of_wall_friction() const override { return friction_.work(); }

 private:
  double refresh_strain() const;
  void rebuild_reference();
  void connect_arrays();
  bool strangers_are_near();
  void take_velocities();
  LargestChange strain_all(double dt);
  Mat2 own_strain(std::size_t particle) const;

  struct Control {
    double rho_c;      ///< of the zero-energy control [kg/(m2 s)]
    double viscosity;  ///< its mu [Pa s]
    bool cells_are_cut;
    ZeroEnergySpring spring = {};
    InterfaceHold hold = {};
  };
  struct SinceReference {
    double strain = 0;                ///< the largest |F - I|
    double travel = 0;                ///< bound on any particle's path since neighbours were looked at [m]
    bool others_move = false;         ///< velocities of others than the particles have taken their place
    bool forces_act = false;          ///< in this step, so that they do work
    std::vector<double> yields = {};  ///< of particles: as in SoilStateView; empty where nobody asks
    std::optional<Fluxes> of_excess = {};  ///< those of an excess pressure alone, once they are asked for
  };

  Model& model_;
  FormulationCase formulation_;
  const ConsistentKernels& kernels_;
  SoilViews soils_;
  Surroundings surroundings_;
  WallFriction friction_;  ///< of no effect without a wall that has it
  Control control_;
  ReferenceConfiguration reference_;
  Fluxes fluxes_;              ///< since the reference
  FlowingSoil flow_;           ///< of no effect in elastic soil
  ConsistentArrays arrays_{};  ///< all these, as the kernels see them
  SinceReference since_;
};

}  // namespace porosph
