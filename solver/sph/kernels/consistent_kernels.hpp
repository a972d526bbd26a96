// The hot loops of the consistent form, over plain arrays.
#pragma once

#include <cstdint>

#include "solver/sph/consistent/pair_stencils.hpp"
#include "solver/sph/kernels/record.hpp"
#include "solver/sph/kernels/soil_view.hpp"
#include "solver/sph/kernels/vector_units.hpp"

namespace porosph {

/// Of a record; the flux comes first.
constexpr int pressure_lane = 4, viscosity_lane = 5, velocity_lane = 6;

// Arrays are per particle unless they say "and ghost": those go on with the ghosts. Tensors of the plane come
// as xx, xy, yx, yy.

/// What belongs to the reference configuration.
struct ReferenceView {
  const PairStencils* stencils;
  const double* correction[4];  ///< L, and ghost
  const double* kappa;          ///< of closed gradients, two numbers each, and ghost [m]; or null
  const double* density;        ///< [kg/m3]
  const double* fill;           ///< share of its cell that a particle fills
};

/// What the forces and rates are summed from.
struct MotionView {
  const double* velocity[2];  ///< and ghost [m/s]
  const double*
      controlled[2];       ///< v + k * displacement, which the zero-energy control acts on, and ghost [m/s]
  const double* pressure;  ///< p_w, and ghost [Pa]; null in dry soil
};

/// Where soils meet: see OwnSides, one entry per particle there.
struct OwnSideView {
  const double* gradient[16];  ///< A
  const double* tie[4];        ///< [Pa]
  const double* along[2];      ///< t
  const double* rate;          ///< k of the zero-energy control [1/s]
};

/// The soil's state since the reference.
struct SoilStateView {
  SoilView soils;
  double* deformation[4];  ///< F
  double* stress;          ///< effective, four numbers each: xx, yy, zz, xy [Pa]
  double* density;         ///< [kg/m3]
  OwnSideView own_sides;
  double* interface_stress;  ///< tau [Pa]
  double* yields;            ///< 1 where the soil yielded in the last step, or else 0; null: nobody asks
};

/// What a step leaves for the next forces.
struct FluxView {
  double* flux[4];               ///< fill P L - mu (dF/dt + k (F - I)), and ghost [Pa]
  const std::uint8_t* listed;    ///< 1 where an own list names the particle: its record is kept
  Record* records;               ///< flux, pressure and velocity or controlled motion of those, and ghost
  const std::uint8_t* mirrored;  ///< 1 where ghosts or closed gradients ask for P
  double* piola;                 ///< P of those, four numbers each, and ghost [Pa]
};

/// Zero-energy control and bulk viscosity.
struct StabilisationView {
  double viscosity;    ///< mu of the zero-energy control [Pa s]
  const double* rate;  ///< k, of its elastic part in each soil, away from others [1/s]
  double bulk_length;  ///< bulk viscosity's strength times h [m]
};

/// Where soil flows: the zero-energy control that its strength bounds,
///   mu = min(viscosity, 0.1 k / gamma + rho h^2 gamma),
/// k the shear strength, at least that under a spacing of soil, gamma the shear rate. All null or 0 where no
/// soil flows: mu is then the same everywhere.
struct FlowView {
  double* viscosity;      ///< mu, and ghost [Pa s]
  double* shear_rate;     ///< gamma where the soil yielded in the last step, or else 0 [1/s]
  const double* mass;     ///< [kg/m]
  double length_squared;  ///< h^2 [m2]
  double weight;          ///< g dx [m2/s2]
};

struct ConsistentArrays {
  ReferenceView reference;
  MotionView motion;
  SoilStateView state;
  FluxView fluxes;
  StabilisationView control;
  FlowView flow;
  double gravity[2];  ///< [m/s2]
};

/// What the loops find out on their way.
struct LargestChange {
  double strain = 0;                          ///< |F - I|
  double speed_squared = 0;                   ///< [m2/s2]
  double plastic_work = 0, viscous_work = 0;  ///< sums, dissipated where soil flows [J/m]
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
