// The hot loops of the paper's forms, over plain arrays.
#pragma once

#include <cstdint>

#include "solver/sph/kernels/soil_view.hpp"
#include "solver/sph/kernels/vector_units.hpp"
#include "solver/sph/paper/pair_lists.hpp"

namespace porosph {

/// What is summed over: of particles, then ghosts.
struct PaperPointsView {
  const double *position[2], *velocity[2];  ///< [m], [m/s]
  const double *volume, *density, *sound;   ///< [m2], [kg/m3], of eq. (16) [m/s]
  const double* stress[3];  ///< xx, yy, xy: sigma' + p_w I [Pa]; of rho_squared sigma' / rho [m2/s2]
  const double* pressure;   ///< p_w [Pa]; read of rho_squared only
};

/// What a step changes, of particles.
struct PaperSoilView {
  SoilView soils;
  double* stress;   ///< effective, four numbers each: xx, yy, zz, xy [Pa]
  double* density;  ///< [kg/m3]
};

/// All that the loops read and write. With the raw gradient g_ab = V_b grad_a W_ab = w (x_b - x_a), all that
/// is asked for are sums over the neighbours b of particle a, particles and ghosts: L_a of eq. (9) comes
/// after the sum.
struct PaperArrays {
  /// Places in `sum`. Of the geometry:
  enum : int { moment_xx, moment_xy, moment_yy, gradient_x, gradient_y };
  /// Of the forces: sum of stress times g, of rho_b Pi_ab g, and, of rho_squared, of p_b g and rho_b g.
  enum : int {
    xx_x,
    xx_y,
    xy_x,
    xy_y,
    yy_x,
    yy_y,
    viscous_x,
    viscous_y,
    pressure_x,
    pressure_y,
    density_x,
    density_y
  };
  /// Of the rates: of (v_b - v_a) (x) g.
  enum : int { rate_xx, rate_xy, rate_yx, rate_yy };  // and then of the velocity gradient
  static constexpr int sums = 12;

  const PairLists* lists;
  double smoothing_length;  ///< h [m]
  double slope;             ///< alpha / h^2 of the kernel [1/m4]
  PaperPointsView points;
  PaperSoilView soil;
  struct {
    double alpha, beta;  ///< both 0: no artificial viscosity
  } viscosity;
  bool rho_squared;

  const double* correction[4];     ///< L of particles: xx, xy, yx, yy
  const double* wall_velocity[2];  ///< of particles: sum over virtual neighbours of stickiness times G [1/m]
  double* weight;                  ///< w of each pair [1/m2]
  double* sum[sums];               ///< per particle
};

/// One stretch of particles each.
struct PaperKernels {
  /// Writes w of all pairs, sum g (x) (x_b - x_a) and sum g.
  void (*geometry)(const PaperArrays&, std::int32_t stretch);
  /// Writes the sums of the momentum equation.
  void (*forces)(const PaperArrays&, std::int32_t stretch);
  /// Writes the velocity gradients, with walls.
  void (*rates)(const PaperArrays&, std::int32_t stretch);
  /// Carries effective stress and density over a step dt [s].
  void (*strain)(const PaperArrays&, std::int32_t stretch, double dt);
};

/// Those compiled for these vector units, which the program must have.
const PaperKernels& paper_kernels(VectorUnits units);

}  // namespace porosph
