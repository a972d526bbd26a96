// Isotropic linear elasticity in plane strain.
#pragma once

#include <Eigen/Core>

#include "solver/case/case.hpp"

namespace porosph {

struct Lame {
  double lambda = 0, mu = 0;  ///< [Pa]
};

/// From E and nu. Throws std::runtime_error unless E > 0 and -1 < nu < 0.5.
Lame lame(const SoilCase&);

/// Effective stress XX YY ZZ XY [Pa] of a displacement gradient, gradient(i, j) = d u_i / d x_j, without z
/// strain.
Eigen::Vector4d plane_strain_stress(const Lame&, const Eigen::Matrix2d& gradient);

/// Principal strain of the largest size in plane strain, of an effective stress XX YY ZZ XY [-].
double largest_strain(const Lame&, const Eigen::Vector4d& effective_stress);

}  // namespace porosph
