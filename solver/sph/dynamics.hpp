// What every form of the motion equation offers to the integrator.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>

#include "solver/case/case.hpp"
#include "solver/model/model.hpp"
#include "solver/particles/state.hpp"

namespace porosph {

class FlowingSoil;

/// Spatial discretisation: from the model's state to accelerations and to strain. It refers to the model that
/// it was made for, whose particle count must not change.
class Dynamics {
 public:
  virtual ~Dynamics() = default;

  /// Brings neighbours and kernel gradients up to date with the positions, where that is due.
  virtual void prepare() = 0;

  /// Accelerations, gravity included and damping left out, of the present state; one per particle [m/s2].
  /// prepare() must have been called for this state.
  virtual void accelerations(std::span<Vec2> out) = 0;

  /// Gradients dv_i/dx_j of the present velocities at the positions of the last prepare() [1/s].
  virtual void velocity_gradients(std::span<Mat2> out) = 0;

  /// Carries effective stress and density over a step dt [s], in which the particles moved with their present
  /// velocities from where the last prepare() saw them. `volume_rates`, if given: of the particles, those of
  /// their water, which the laws of soil that flows take for their own.
  virtual void strain(double dt, std::span<const double> volume_rates = {}) = 0;

  /// From the next strain() on, the excess pore pressure p_e of each particle [Pa] acts with its effective
  /// stress, as one stress; `excess` is read whenever the particles are strained.
  virtual void carry_excess(std::span<const double> excess);

  /// Accelerations that pressures `excess` [Pa] alone give, one per particle [m/s2]. Walls mirror them.
  virtual void excess_accelerations(std::span<const double> excess, std::span<Vec2> out);
  /// dF/dt of each particle with these velocities [m/s], as walls see them that it slides along [1/s];
  /// linear.
  virtual void sliding_rates(std::span<const Vec2> velocities, std::span<Mat2> out);
  /// How fast each particle's volume grows at such rates, over its volume [1/s]: the adjoint of the above.
  /// `ahead`: not as the soil is deformed now, but so much later at these rates [s].
  virtual void volume_rates(std::span<const Mat2> rates, std::span<double> out, double ahead = 0);

  /// Saves or restores what is kept from step to step, particles apart, which must be as they were at the
  /// saving. Lists and gradients are rebuilt by the code that made them first. Throws StateError.
  virtual void visit(StateArchive& state) = 0;

  /// What it does where soil yields and flows, if anything.
  virtual double work_of_wall_friction() const { return 0; }  ///< while soil flows [J/m]
  virtual const FlowingSoil* flow() const { return nullptr; }

  /// How often neighbours were searched, kernel gradients made, and of these closed for disorder.
  struct Counts {
    std::int64_t searches = 0, refreshes = 0, closures = 0;
  };
  Counts counts;
};

inline void Dynamics::carry_excess(std::span<const double>) {
  throw std::logic_error("this form of the motion equation carries no excess pore pressure");
}

inline void Dynamics::excess_accelerations(std::span<const double> excess, std::span<Vec2>) {
  carry_excess(excess);
}
inline void Dynamics::sliding_rates(std::span<const Vec2>, std::span<Mat2>) { carry_excess({}); }
inline void Dynamics::volume_rates(std::span<const Mat2>, std::span<double>, double) { carry_excess({}); }

/// The dynamics that the case asks for.
std::unique_ptr<Dynamics> make_dynamics(const FormulationCase& formulation, Model& model);

/// What makes the dynamics of a simulation.
using DynamicsMaker = std::function<std::unique_ptr<Dynamics>(const FormulationCase&, Model&)>;

}  // namespace porosph
