// The paper's motion equations: how stress and pore pressure of a pair enter.
//
// With G_ab = V_b L_a grad_a W_ab (eq. 9; V_b = m_b / rho_b) all of them are sums of a neighbour's values
// times G_ab:
//
//   eqs. (15), (17), (24):  1/rho_a sum (sigma'_a + sigma'_b) G_ab
//   eqs. (14), (25):        sum rho_b (sigma'_a / rho_a^2 + sigma'_b / rho_b^2) G_ab
//   eq. (17):               1/rho_a sum (p_b + p_a) G_ab
//   eqs. (22), (24), (25):  1/rho_a sum (p_b - p_a) G_ab
#pragma once

#include "solver/case/case.hpp"

namespace porosph {

struct PaperForm {
  bool stress_over_rho_squared;  ///< eqs. (14), (25)
  double own_pressure;           ///< +1: p_b + p_a (eq. 17); -1: p_b - p_a (eq. 22)

  explicit PaperForm(Motion motion)
      : stress_over_rho_squared(motion == Motion::rho_squared),
        own_pressure(motion == Motion::conventional ? 1.0 : -1.0) {}
};

}  // namespace porosph
