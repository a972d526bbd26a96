#include "solver/reference/fem/elasticity.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace porosph {

Lame lame(const SoilCase& soil) {
  const double e = soil.youngs_modulus, nu = soil.poissons_ratio;
  if (!(e > 0) || !(nu > -1 && nu < 0.5))
    throw std::runtime_error(
        fmt::format("finite elements: soil '{}' has E = {} Pa, nu = {}; allowed are E > 0 and -1 < nu < 0.5",
                    soil.name, e, nu));
  return {e * nu / ((1 + nu) * (1 - 2 * nu)), e / (2 * (1 + nu))};
}

Eigen::Vector4d plane_strain_stress(const Lame& m, const Eigen::Matrix2d& gradient) {
  const double pressure_part = m.lambda * gradient.trace();
  return {pressure_part + 2 * m.mu * gradient(0, 0), pressure_part + 2 * m.mu * gradient(1, 1), pressure_part,
          m.mu * (gradient(0, 1) + gradient(1, 0))};
}

double largest_strain(const Lame& m, const Eigen::Vector4d& s) {
  const double volumetric = (s[0] + s[1]) / (2 * (m.lambda + m.mu));
  const double xx = (s[0] - m.lambda * volumetric) / (2 * m.mu),
               yy = (s[1] - m.lambda * volumetric) / (2 * m.mu), xy = s[3] / (2 * m.mu);
  return std::abs(xx + yy) / 2 + std::hypot((xx - yy) / 2, xy);
}

}  // namespace porosph
