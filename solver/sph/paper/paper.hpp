// The paper's motion equations (17), (24), (25) on the present configuration.
#pragma once

#include <array>
#include <vector>

#include "solver/boundary/ghosts.hpp"
#include "solver/sph/dynamics.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"
#include "solver/sph/kernels/paper_kernels.hpp"
#include "solver/sph/kernels/record.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"
#include "solver/sph/paper/paper_form.hpp"
#include "solver/sph/soil_views.hpp"
#include "solver/sph/stabilisation/artificial_viscosity.hpp"

namespace porosph {

/// Kernel gradients are made anew in every step. Rollers are mirrored ghosts; fixed walls are rows of virtual
/// particles that stay where they are, take the stress of the particle that looks at them, and the velocity
/// -min(d_b / d_a, 1/2) v_a that makes it stick to the wall (Morris et al. 1997; Bui et al. 2008).
class PaperDynamics final : public Dynamics {
 public:
  PaperDynamics(const FormulationCase& formulation, Model& model, VectorUnits units = vector_units());

  void prepare() override;
  void accelerations(std::span<Vec2> out) override;
  void velocity_gradients(std::span<Mat2> out) override;
  void strain(double dt) override;
  void visit(StateArchive& state) override;

 private:
  void make_virtual_particles();
  void search();
  void make_room();
  void connect_arrays();
  void move_ghosts();
  void make_gradients();
  void correct(std::size_t a);
  Mat2 make_wall_gradients(std::size_t a);
  void sum_wall_gradients(std::size_t a);
  void fill_ghost_velocities();
  void fill_stress();
  void fill_artificial_stress();
  Vec2 stress_and_pressure(std::size_t a) const;
  Vec2 viscous(std::size_t a) const;
  Vec2 tension_control(std::size_t a) const;
  Vec2 stabilisation_at_walls(std::size_t a) const;
  Vec2 corrected(std::size_t a, const Vec2& v) const;
  Vec2 corrected(std::size_t a, int x, int y) const;

  Model& model_;
  FormulationCase formulation_;
  PaperForm form_;
  ArtificialViscosity viscosity_;
  CubicSpline<2> kernel_;
  const PaperKernels& kernels_;
  SoilViews soils_;
  double skin_;                 ///< neighbours are searched this much beyond the support [m]
  double artificial_exponent_;  ///< n = W(0) / W(dx)

  std::size_t fixed_walls_ = 0;
  std::vector<Vec2> virtual_points_;
  std::vector<double> virtual_volume_;
  std::vector<std::int32_t> virtual_wall_;
  std::vector<double> virtual_pressure_;

  std::vector<Vec2> points_;  ///< of particles, then ghosts, like these:
  std::array<std::vector<double>, 2> position_, velocity_;
  std::array<std::vector<double>, 3> stress_;  ///< as the kernels ask for it
  std::vector<double> volume_, density_, sound_, pressure_;
  Ghosts ghosts_;               ///< behind rollers
  std::vector<Vec2> searched_;  ///< positions at the last search
  NeighbourList neighbours_, wall_neighbours_;
  PairRuns runs_;  ///< of neighbours_
  PaperArrays arrays_{};
  std::vector<Record> weight_;  ///< of the runs' pairs; whole cache lines
  std::array<std::vector<double>, PaperArrays::sums> sum_;
  std::array<std::vector<double>, 4> correction_;  ///< L
  std::vector<Vec2> wall_gradient_;                ///< G of each pair with a virtual particle
  std::vector<double> stickiness_;                 ///< of each of them: 1 + min(d_b / d_a, 1/2)
  std::vector<Vec2> gradient_sum_;                 ///< sum of G_ab over particles and ghosts
  struct WallSums {
    Vec2 gradient = Vec2::Zero(), pressure = Vec2::Zero();
  };
  std::vector<WallSums> wall_sums_;                   ///< sums over virtual neighbours of G and p_b G
  std::array<std::vector<double>, 2> wall_velocity_;  ///< of stickiness G
  std::vector<Eigen::Vector3d> artificial_stress_;    ///< R, of particles and ghosts
  bool any_tension_ = false;
};

}  // namespace porosph
