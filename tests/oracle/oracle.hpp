// The equations of motion written out plainly, for the solver to agree with: every pair of points, nothing
// stored, nothing rearranged.
#pragma once

#include <vector>

#include "solver/case/case.hpp"
#include "solver/model/model.hpp"

namespace porosph::oracle {

struct Result {
  std::vector<Vec2> acceleration;       ///< without damping [m/s2]
  std::vector<Mat2> velocity_gradient;  ///< dv_i/dx_j [1/s]
};

/// p_w of the image at `image` of a particle at `root` [Pa]. Where the level passes between them, the mean of
/// both is p_w at the wall.
inline double pressure_of_image(const StandingWater& water, const Vec2& root, const Vec2& image) {
  const double x = root.x(), middle = 0.5 * (root.y() + image.y());
  const bool passes = (water.depth(x, root.y()) > 0) != (water.depth(x, image.y()) > 0);
  return passes ? 2 * water.pore_pressure(x, middle) - water.pore_pressure(x, root.y())
                : water.pore_pressure(x, image.y());
}

/// Eqs. (14), (15), (17), (24) and (25) with C_ab. The virtual particles of fixed walls belong to the soil as
/// it lay in `start`.
Result paper_form(const FormulationCase& formulation, const Model& start, const Model& now);

/// The consistent form (see ConsistentDynamics), on the configuration of `reference`; the zero-energy control
/// has the strength that the soil of `start` gives it. `last_step`: the time step that led to `now`, zero
/// where `now` is the reference itself [s].
Result consistent_form(const FormulationCase& formulation, const Model& start, const Model& reference,
                       const Model& now, double last_step);

}  // namespace porosph::oracle
