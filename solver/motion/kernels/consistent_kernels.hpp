// The hot loops of the consistent form, over plain arrays.
#pragma once

#include <cstdint>

#include "solver/motion/kernels/record.hpp"
#include "solver/motion/kernels/vector_units.hpp"
#include "solver/motion/pair_stencils.hpp"

namespace porosph {

constexpr int pressure_lane = 4, velocity_lane = 6;  ///< of a record; the flux comes first

/// All that the loops read and write. Arrays are per particle unless they say "and image": those go on with
/// the images. Tensors of the plane come as xx, xy, yx, yy.
struct ConsistentArrays {
  const PairStencils* stencils;

  const double* correction[4];      ///< L, and image
  const double* kappa;              ///< of closed gradients, two numbers each, and image [m]; or null
  const double* reference_density;  ///< [kg/m3]
  const double* fill;               ///< share of its cell that a particle fills
  const double *shear_modulus, *bulk_modulus,
      *no_tension;  ///< [Pa], [Pa], 1 or 0; one entry only in one soil
  bool one_soil, wet;
  double zero_energy_viscosity;  ///< mu [Pa s]
  double zero_energy_rate;       ///< k, of the control's elastic part [1/s]
  double bulk_length;            ///< bulk viscosity's strength times h [m]
  double gravity[2];             ///< [m/s2]

  double* deformation[4];  ///< F
  double* stress;          ///< effective, four numbers each: xx, yy, zz, xy [Pa]
  double* density;         ///< [kg/m3]

  double* flux[4];            ///< fill P L - mu (dF/dt + k (F - I)), and image [Pa]
  const double* pressure;     ///< p_w, and image [Pa]
  const double* velocity[2];  ///< and image [m/s]
  const double* motion[2];    ///< v + k * displacement, and image [m/s]

  const std::uint8_t* listed;    ///< 1 where an own list names the particle: its record is kept
  Record* records;               ///< flux, pressure and velocity or motion of those, and image
  const std::uint8_t* mirrored;  ///< 1 where images or closed gradients ask for P
  double* piola;                 ///< P of those, four numbers each, and image [Pa]
};

/// What the loops find out on their way.
struct LargestChange {
  double strain = 0;         ///< |F - I|
  double speed_squared = 0;  ///< [m2/s2]
};

/// One tile of particles each.
struct ConsistentKernels {
  /// dF/dt, four numbers each, written for the whole tile.
  void (*rates)(const ConsistentArrays&, std::int32_t tile, double* out);
  /// Carries F, the stress and the density over a step dt [s] and writes flux, records and P.
  void (*strain)(const ConsistentArrays&, std::int32_t tile, double dt, LargestChange&);
  /// Accelerations with gravity, two numbers each for all particles [m/s2].
  void (*accelerate)(const ConsistentArrays&, std::int32_t tile, double* out);
};

/// Those compiled for these vector units, which the program must have.
const ConsistentKernels& consistent_kernels(VectorUnits units);

}  // namespace porosph
