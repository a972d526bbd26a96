// What a soil other than linear elastic has to say: the place to add one from outside.
#pragma once

#include <cstddef>

#include "solver/tensor.hpp"

namespace porosph {

/// One particle's step, for a material to answer with the stress at its end.
struct MaterialStep {
  std::size_t particle = 0;  ///< its place in Particles, for a material that keeps state of its own
  Stress old;                ///< effective, at the start of the step [Pa]
  Stress elastic;            ///< at its end if the soil were linear elastic (eq. 30), with its E and nu [Pa]
  Gradient velocity_gradient;  ///< dv_i/dx_j at the middle of the step [1/s]
  double dt = 0;               ///< [s]
};

/// A constitutive model of its own. The soil's E and nu still set the time step and the bulk viscosity: no
/// stiffness may exceed theirs.
class Material {
 public:
  virtual ~Material() = default;

  /// Effective stress at the end of the step [Pa]. Called once per step for each of its particles, from
  /// several threads at a time for different particles.
  virtual Stress stress(const MaterialStep& step) = 0;
};

}  // namespace porosph
