// The proposed form, eq. (24), in plain loops: the line that the solver's speed is measured against.
#pragma once

#include <vector>

#include "solver/sph/dynamics.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"
#include "solver/sph/stabilisation/artificial_viscosity.hpp"

namespace porosph::bench {

/// What a straightforward implementation of the paper does: each particle's sums run over its neighbour list,
/// the correction matrix is made in every step, and kernel gradients are computed where they are used. Points
/// are structs, ghosts and virtual particles (of fixed walls) points like others, and nothing is stored per
/// pair. Neighbours are searched with a skin, as in the solver. Same results as the solver's proposed form.
class PlainDynamics final : public Dynamics {
 public:
  /// Throws std::invalid_argument for another form than the proposed one, or with artificial stress.
  PlainDynamics(const FormulationCase& formulation, Model& model);

  void prepare() override;
  void accelerations(std::span<Vec2> out) override;
  void velocity_gradients(std::span<Mat2> out) override;
  void strain(double dt, std::span<const double> volume_rates) override;
  /// Throws std::logic_error: a measurement is not saved.
  void visit(StateArchive& state) override;

 private:
  struct Point {
    Vec2 x = Vec2::Zero(), v = Vec2::Zero();
    Mat2 stress = Mat2::Zero();  ///< effective [Pa]
    double pressure = 0, density = 0, volume = 0, sound = 0;
  };

  void make_virtual_particles();
  void search();
  void fill_points();
  void fill_velocities();
  Point mirrored(std::size_t ghost) const;
  Point virtual_particle(std::size_t b, std::size_t seen_by) const;
  template <class Use>
  void for_neighbours(std::size_t a, Use use) const;
  Mat2 correction(std::size_t a) const;
  Vec2 acceleration(std::size_t a) const;
  Mat2 velocity_gradient(std::size_t a) const;

  Model& model_;
  bool corrected_;
  ArtificialViscosity viscosity_;
  CubicSpline<2> kernel_;
  double skin_;                  ///< neighbours are searched this much beyond the support [m]
  std::size_t fixed_walls_ = 0;  ///< they come first among the walls
  std::vector<Point> virtuals_;
  std::vector<std::int32_t> virtual_wall_;
  std::vector<Image> ghosts_;
  std::vector<std::int32_t> ghost_root_;  ///< the particle that each ghost stems from
  std::vector<Vec2> searched_;            ///< positions at the last search
  std::vector<Point> points_;             ///< particles, ghosts, virtual particles
  std::size_t first_virtual_ = 0;
  NeighbourList neighbours_;
  std::vector<Mat2> correction_;
};

}  // namespace porosph::bench
