// The paper's motion equations (17), (24), (25) on the present configuration.
#pragma once

#include <array>
#include <vector>

#include "solver/sph/dynamics.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"
#include "solver/sph/kernels/paper_kernels.hpp"
#include "solver/sph/kernels/record.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"
#include "solver/sph/paper/fixed_walls.hpp"
#include "solver/sph/paper/paper_points.hpp"
#include "solver/sph/paper/tension_control.hpp"
#include "solver/sph/soil_views.hpp"
#include "solver/sph/stabilisation/artificial_viscosity.hpp"
#include "solver/sph/wall_stop.hpp"

namespace porosph {

/// Sums over the pairs of particles and ghosts, per particle.
struct PaperSums {
  std::vector<Vec2> searched;  ///< positions at the search for neighbours; empty before the first
  NeighbourList neighbours;
  PairLists lists;              ///< of the neighbours
  std::vector<Record> weights;  ///< of the pairs; whole cache lines
  std::array<std::vector<double>, PaperArrays::sums> sum;
  std::array<std::vector<double>, 4> correction;  ///< L of eq. (10)
  std::vector<Vec2> gradient;                     ///< sum of G_ab [1/m]

  void make_room();
  void connect(PaperArrays& arrays);
  Mat2 correction_of(std::size_t a) const;
  /// L of particle a times the vector of these two sums.
  Vec2 corrected(std::size_t a, int x, int y) const;
};

/// Kernel gradients are rebuilt in every step. Rollers are mirrored ghosts, fixed walls virtual particles.
class PaperDynamics final : public Dynamics {
 public:
  PaperDynamics(const FormulationCase& formulation, Model& model, VectorUnits units = vector_units());

  void prepare() override;
  void accelerations(std::span<Vec2> out) override;
  void velocity_gradients(std::span<Mat2> out) override;
  void strain(double dt, std::span<const double> volume_rates) override;
  void visit(StateArchive& state) override;

 private:
  double reach() const;
  void search();
  void connect_arrays();
  void make_gradients();
  void correct(std::size_t a);
  Vec2 stress_and_pressure(std::size_t a) const;
  Vec2 viscous(std::size_t a) const;
  Vec2 tension_control(std::size_t a) const;
  Vec2 stabilisation_at_walls(std::size_t a) const;

  Model& model_;
  FormulationCase formulation_;
  ArtificialViscosity viscosity_;
  CubicSpline<2> kernel_;
  const PaperKernels& kernels_;
  SoilViews soils_;
  FixedWalls walls_;
  PaperPoints points_;
  PaperSums sums_;
  TensionControl tension_;
  WallStop stop_;         ///< where soil yields
  PaperArrays arrays_{};  ///< all these, as the kernels see them
};

}  // namespace porosph
