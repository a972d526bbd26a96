// The consistent form: the exact adjoint of the strain rate, on a reference configuration.
#pragma once

#include <array>
#include <vector>

#include "solver/kernel/cubic_spline.hpp"
#include "solver/motion/dynamics.hpp"
#include "solver/motion/kernels/consistent_kernels.hpp"
#include "solver/motion/pair_stencils.hpp"
#include "solver/motion/soil_arrays.hpp"

namespace porosph {

/// Plane tensors, not symmetric: arrays of xx, xy, yx and yy.
using PlaneTensors = std::array<std::vector<double>, 4>;
using PlaneTensor = std::array<double, 4>;

/// Each stress acts with its own correction matrix (Bonet and Lok 1999), so that the forces are the adjoint
/// of the strain-rate operator and conserve momentum and energy:
///
///   rho0_a a_a = sum_b V_b (P_a L_a + P_b L_b) grad W_ab  +  J_a F_a^-T L_a sum_b V_b (p_b - p_a) grad W_ab
///   +  rho0_a g dF_a/dt    = sum_b V_b (v_b - v_a) (x) L_a grad W_ab,       P = J sigma' F^-T
///
/// In disorder, L_a grad W_ab becomes L_a grad W_ab + (kappa_b - kappa_a) F_ab: see closed_gradients.hpp.
///
/// Kernel gradients, volumes V and densities rho0 belong to a reference configuration: that of the last
/// refresh. F is the deformation since then, so the reference may be old without an error in strain or
/// energy. It is made anew when |F - I| exceeds the case's refresh_strain, and when particles come near that
/// were no neighbours.
class ConsistentDynamics final : public Dynamics {
 public:
  ConsistentDynamics(const FormulationCase& formulation, Model& model, VectorUnits units = vector_units());

  void prepare() override;
  void accelerations(std::span<Vec2> out) override;
  void velocity_gradients(std::span<Mat2> out) override;
  void strain(double dt) override;
  void visit(StateArchive& state) override;

 private:
  void refresh();
  void make_reference();
  void restore_reference(std::vector<Vec2>& positions, std::vector<double>& densities);
  void make_images();
  void make_gradients();
  void make_corrections();
  void close();
  void set_zero_energy_rate();
  void make_one_sided_gradients();
  void choose_records();
  void start_from_reference();
  void make_room();
  void connect_arrays();
  bool strangers_are_near();

  LargestChange strain_all(double dt);
  void update_velocities();
  void update_motion();
  void update_pressures();
  void update_image_fluxes();
  void update_flux_records();
  void extrapolate_stress();

  /// Calls use(i) for the images from `first` on: those of particles, on all threads, then those of images,
  /// which need their parents.
  template <class Use>
  void for_images(std::size_t first, Use&& use) {
    const auto particles = static_cast<std::int32_t>(model_.particles.size());
#pragma omp parallel for schedule(static)
    for (std::size_t i = first; i < images_.size(); ++i)
      if (images_[i].parent < particles) use(i);
    for (const std::size_t i : images_of_images_)
      if (i >= first) use(i);
  }

  /// Writes the vector of_particle(a) of each particle, and of their images what moves with it, into `field`
  /// and the records' velocity lanes.
  template <class Of>
  void spread(std::array<std::vector<double>, 2>& field, Of&& of_particle) {
    double *x = field[0].data(), *y = field[1].data();
    const auto write = [&](std::size_t i, const Vec2& v) {
      x[i] = v.x(), y[i] = v.y();
      if (listed_[i]) records_[i].q[velocity_lane] = v.x(), records_[i].q[velocity_lane + 1] = v.y();
    };
    const std::size_t n = model_.particles.size();
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < n; ++a) write(a, of_particle(a));
    for_images(0, [&](std::size_t i) {
      const std::int32_t parent = images_[i].parent;
      write(n + i, reflection_[images_[i].wall].velocity * Vec2(x[parent], y[parent]));
    });
  }

  Mat2 correction(std::size_t i) const { return get(correction_, i); }
  static Mat2 get(const PlaneTensors& t, std::size_t i) {
    return (Mat2() << t[0][i], t[1][i], t[2][i], t[3][i]).finished();
  }
  static void set(PlaneTensors& t, std::size_t i, const Mat2& m) {
    t[0][i] = m(0, 0), t[1][i] = m(0, 1), t[2][i] = m(1, 0), t[3][i] = m(1, 1);
  }

  Model& model_;
  FormulationCase formulation_;
  CubicSpline<2> kernel_;
  const ConsistentKernels& kernels_;
  SoilArrays soil_;
  double zero_energy_viscosity_;  ///< mu = kappa rho c_p h [Pa s]
  double zero_energy_rate_ = 0;   ///< the control acts on v + rate * displacement since the reference [1/s]
  struct Reflection {
    Mat2 stress;    ///< R
    Mat2 velocity;  ///< of what moves: R at a roller, -I at a fixed wall
  };
  std::vector<Reflection> reflection_;  ///< of each wall

  // The reference configuration. Images of walls that extrapolate the stress come first, then those that
  // mirror it.
  std::vector<Vec2> points_;  ///< particles, then images [m]
  std::vector<Image> images_;
  std::vector<std::size_t> images_of_images_;
  std::size_t extrapolated_ = 0;  ///< how many images have their stress extrapolated
  PairStencils stencils_;
  PlaneTensors correction_;  ///< L, of particles and images
  std::vector<Vec2> kappa_;  ///< of particles and images; empty where the gradients are closed without [m]
  std::vector<double> volume_, reference_density_;
  std::vector<std::int32_t> root_;  ///< of each image: the particle it stems from
  struct OneSided {
    std::int32_t particle;
    std::vector<std::int32_t> neighbours;
    std::vector<Vec2> gradient;  ///< exact for linear fields without the extrapolated images
  };
  std::vector<OneSided> one_sided_;
  std::vector<std::int32_t> one_sided_of_;  ///< of each extrapolated image
  std::vector<std::uint8_t> listed_;        ///< of particles and images: an own list names it
  std::vector<std::uint8_t> mirrored_;      ///< of particles: images ask for its stress

  // The state since then.
  PlaneTensors deformation_;  ///< F
  /// fill P L - mu (dF/dt + rate (F - I)), of particles and images [Pa]
  PlaneTensors flux_;
  std::vector<double> pressure_;                 ///< p_w, of particles and images [Pa]
  std::array<std::vector<double>, 2> velocity_;  ///< of particles and images [m/s]
  std::array<std::vector<double>, 2> motion_;    ///< v + rate * displacement, likewise, where rate is not 0
  std::vector<Record> records_;                  ///< flux, p_w and velocity of those that are listed
  std::vector<std::array<Mat2, 2>> stress_gradient_;  ///< of P along x and y, of each one-sided stencil
  std::vector<PlaneTensor> piola_;                    ///< P of mirrored particles and of images [Pa]
  std::vector<Vec2> image_positions_;                 ///< where the images are now [m]
  bool wet_ = false;                                  ///< dry soil has no pore pressure to look after
  ConsistentArrays arrays_{};                         ///< all these, as the kernels see them
  double largest_strain_ = 0;                         ///< |F - I| since the refresh
  double travel_ = 0;  ///< bound on any particle's path since neighbours were looked at [m]
  bool have_reference_ = false;
};

}  // namespace porosph
