// The surface of soil that has flowed, and how far it went.
#pragma once

#include <vector>

#include "solver/output/frame.hpp"

namespace porosph {

/// Columns of one width; where there is no soil, thickness is 0 and the surface is not a number.
struct SurfaceProfile {
  std::vector<double> x;          ///< middle of each column [m]
  std::vector<double> surface;    ///< top of the highest cell that lies over the middle of the column [m]
  std::vector<double> thickness;  ///< volume of the soil in the column over its width [m]
  double mean_x = 0;              ///< of all soil, by volume [m]
  double quantile95 = 0, quantile99 = 0;  ///< x that so much of the volume has not passed [m]
  double area = 0;                        ///< of all soil [m2]
};

/// Particles count as squares of their volume. `width` of the columns > 0 [m]. Throws std::runtime_error for
/// a frame without particles.
SurfaceProfile surface_profile(const Frame& frame, double width);

}  // namespace porosph
