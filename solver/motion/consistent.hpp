// The consistent form: the exact adjoint of the strain rate, on a reference configuration.
#pragma once

#include <vector>

#include "solver/kernel/cubic_spline.hpp"
#include "solver/motion/dynamics.hpp"
#include "solver/motion/pair_sums.hpp"
#include "solver/neighbours/neighbour_list.hpp"

namespace porosph {

/// Each stress acts with its own correction matrix (Bonet and Lok 1999), so that the forces are the adjoint
/// of the strain-rate operator and conserve momentum and energy:
///
///   rho0_a a_a = sum_b V_b (P_a L_a + P_b L_b) grad W_ab  +  J_a F_a^-T L_a sum_b V_b (p_b - p_a) grad W_ab
///   +  rho0_a g dF_a/dt    = sum_b V_b (v_b - v_a) (x) L_a grad W_ab,       P = J sigma' F^-T
///
/// Kernel gradients, volumes V and densities rho0 belong to a reference configuration: that of the last
/// refresh. F is the deformation since then, so the reference may be old without an error in strain or
/// energy. It is made anew when |F - I| exceeds the case's refresh_strain, and when particles come near that
/// were no neighbours.
class ConsistentDynamics final : public Dynamics {
 public:
  ConsistentDynamics(const FormulationCase& formulation, Model& model);

  void prepare() override;
  void accelerations(std::span<Vec2> out) override;
  void velocity_gradients(std::span<Mat2> out) override;
  void strain(double dt) override;

 private:
  void refresh();
  void make_images();
  void make_gradients();
  void make_one_sided_gradients();
  void start_from_reference();
  bool strangers_are_near();

  Mat2 deformation_rate(std::size_t a) const;
  struct Largest {
    double strain = 0, speed_squared = 0;
  };
  Largest strain_all(double dt);
  Largest strain_block(std::size_t first, std::size_t last, double dt);
  void update_pressure_lanes();
  void fill_image_records();
  void fill_image_velocities();
  void extrapolate_stress();
  void accelerate_range(std::size_t first, std::size_t last, Vec2* out) const;

  Model& model_;
  FormulationCase formulation_;
  CubicSpline<2> kernel_;
  double zero_energy_viscosity_;  ///< mu = kappa rho c_p h [Pa s]
  double zero_energy_rate_;       ///< the control acts on v + rate * displacement since the reference [1/s]

  // The reference configuration. Images of walls that extrapolate the stress come first, then those that
  // mirror it.
  std::vector<Vec2> points_;  ///< particles, then images [m]
  std::vector<Image> images_;
  std::size_t extrapolated_ = 0;  ///< how many images have their stress extrapolated
  NeighbourList neighbours_;
  std::vector<PairGradient> gradient_;
  std::vector<double> weight_;      ///< gradient = weight * (x_b - x_a) [1/m2]
  std::vector<Mat2> correction_;    ///< L, of particles and images
  std::vector<Vec2> gradient_sum_;  ///< sum_b of the pair gradients [1/m]
  std::vector<double> weight_sum_;  ///< [1/m2]
  std::vector<double> volume_, reference_density_;
  std::vector<std::int32_t> root_;  ///< of each image: the particle it stems from
  struct OneSided {
    std::int32_t particle;
    std::vector<std::int32_t> neighbours;
    std::vector<Vec2> gradient;  ///< exact for linear fields without the extrapolated images
  };
  std::vector<OneSided> one_sided_;
  std::vector<std::int32_t> one_sided_of_;  ///< of each extrapolated image

  // The state since then.
  std::vector<Mat2> deformation_;  ///< F
  std::vector<Mat2> piola_;        ///< first Piola-Kirchhoff stress P, of particles and images [Pa]
  /// Of particles and images: fill P L - mu (dF/dt + rate (F - I)) (columns), p_w, v + rate * displacement.
  std::vector<Record> records_;
  std::vector<Vec2> velocities_;       ///< of particles and images
  std::vector<Vec2> image_positions_;  ///< where the images are now [m]
  double largest_strain_ = 0;          ///< |F - I| since the refresh
  double travel_ = 0;                  ///< bound on any particle's path since neighbours were looked at [m]
  bool have_reference_ = false;
};

}  // namespace porosph
