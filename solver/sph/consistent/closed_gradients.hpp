// Gradients whose adjoint leaves a uniform stress in balance, however disordered the particles are.
#pragma once

#include <span>
#include <vector>

#include "solver/boundary/ghosts.hpp"
#include "solver/sph/consistent/pair_stencils.hpp"

namespace porosph {

/// A configuration's corrected gradients, sum_b (f_b - f_a) L_a G_ab with the stencils' G_ab = w_ab x_ab.
struct CorrectedGradients {
  const PairStencils& stencils;      ///< of the particles
  std::span<const double> volumes;   ///< of the cells of particles and ghosts [m2]
  std::span<const double> fill;      ///< of the particles: part of the cell that is soil
  std::span<const Mat2> correction;  ///< L of the particles
  const Ghosts& ghosts;
  double spacing;  ///< [m]
};

/// With kappa, the gradient is sum_b (f_b - f_a) w_ab (L_a x_ab + kappa_b - kappa_a).
struct Closure {
  std::vector<Vec2> kappa;       ///< of particles and ghosts [m]; empty where they are closed as they are
  std::vector<Mat2> correction;  ///< L of the particles, so that linear fields still have exact gradients
};

/// Gradients that are exact for linear fields do not make a uniform stress balance: its force on particle a
/// is the stress times n_a = sum_b V_b F_ab [(L_a + L_b) x_ab + 2 (kappa_b - kappa_a)], which vanishes in a
/// lattice alone. (In meshfree Galerkin methods this is the integration constraint: Chen, Hillman and Rueter,
/// Int. J. Numer. Meth. Engng 95, 2013.) kappa is the smallest change of the gradients, weighted with F_ab,
/// that makes n_a vanish to 0.001 / spacing (RMS) wherever no surface is near. At surfaces n_a is their
/// normal.
Closure close_gradients(const CorrectedGradients& gradients);

}  // namespace porosph
