// The hot loops of the consistent form, over plain arrays. Views and loops are templates of the space; the
// program runs those of the plane.
#pragma once

#include <cstdint>
#include <type_traits>

#include "solver/sph/consistent/pair_stencils.hpp"
#include "solver/sph/kernels/record.hpp"
#include "solver/sph/kernels/soil_view.hpp"
#include "solver/sph/kernels/vector_units.hpp"

namespace porosph {

/// In a record; the flux comes first.
constexpr int pressure_lane = Record::pressure, viscosity_lane = Record::viscosity,
              velocity_lane = Record::velocity;

/// The soil strains across the plane as well, by v_x / x.
template <class Space>
constexpr bool has_hoop = std::is_same_v<Space, Axisymmetric>;

// Arrays are per particle unless they say "and ghost": those continue with the ghosts. Matrices come row by
// row (in the plane xx, xy, yx, yy), gradients of Axisymmetric with the hoop's number after them, and
// stresses in the order of Symmetric.
template <class Space>
constexpr int matrix_size = Space::dim* Space::dim;
template <class Space>
constexpr int gradient_size = matrix_size<Space> + (has_hoop<Space> ? 1 : 0);
template <class Space>
constexpr int stress_size = static_cast<int>(sizeof(Symmetric<Space>) / sizeof(double));

/// What belongs to the reference configuration.
template <class Space>
struct ReferenceViewIn {
  const PairStencilsIn<Space>* stencils;
  const double* correction[matrix_size<Space>];  ///< L, and ghost
  const double* kappa[Space::dim];               ///< of closed gradients, and ghost [m]; or null
  const double* density;                         ///< [kg/m3]
  const double* fill;                            ///< share of its cell that a particle fills
  const double* radius;                          ///< X of Axisymmetric, and ghost [m]; otherwise unused
};

/// What the forces and rates are summed from.
template <class Space>
struct MotionViewIn {
  const double* velocity[Space::dim];    ///< and ghost [m/s]
  const double* controlled[Space::dim];  ///< v + k * displacement, which the zero-energy control acts on, and
                                         ///< ghost [m/s]
  const double* pressure;                ///< p_w, and ghost [Pa]; null in dry soil
};

/// Where soils meet, in the plane only: see OwnSides, one entry per particle there.
struct OwnSideView {
  const double* gradient[16];  ///< A
  const double* tie[4];        ///< [Pa]
  const double* along[2];      ///< t
  const double* change[2];     ///< of the derivative along t: see AlongInterfaces [1/s]; null: none
  const double* rate;          ///< k of the zero-energy control [1/s]
};

/// The soil's state since the reference.
template <class Space>
struct SoilStateViewIn {
  SoilView soils;
  double* deformation[gradient_size<Space>];  ///< F
  double* stress;                             ///< effective, stress_size numbers each [Pa]
  double* density;                            ///< [kg/m3]
  OwnSideView own_sides;
  double* interface_stress;  ///< tau [Pa]
  double* yields;            ///< 1 where the soil yielded in the last step, or else 0; null: nobody asks
  const double* excess;      ///< p_e, which acts with the effective stress [Pa]; null: none
  const double*
      volume_rate;  ///< where soil flows: trace of the velocity gradient that laws see; null: its own
};

/// What a step leaves for the next forces. In Axisymmetric each particle stands for a radian: the flux is
/// multiplied by X, and so is the viscosity in the records.
template <class Space>
struct FluxViewIn {
  double* flux[matrix_size<Space>];  ///< fill P L - mu (dF/dt + k (F - I)), and ghost [Pa; Pa m]
  const std::uint8_t* listed;        ///< 1 where an own list names the particle: its record is kept
  RecordIn<Space>* records;      ///< flux, pressure, viscosity and velocity or controlled motion, and ghost
  const std::uint8_t* mirrored;  ///< 1 where ghosts or closed gradients ask for P
  double* piola[matrix_size<Space>];  ///< P of those, and ghost [Pa]
  double* hoop;                       ///< the hoop's part of P in Axisymmetric [Pa]; otherwise unused
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
  double* sheared;        ///< grows by the shear strain of the steps in which the soil yields
  const double* bears;    ///< 1, or 0 for particles that are loose: they bear no stress
  const double* deforms;  ///< 1, or 0 for particles whose F the steps leave as it is
  const double* mass;     ///< [kg/m]
  double length_squared;  ///< h^2 [m2]
  double weight;          ///< g dx [m2/s2]
};

/// Diffusion of stress where soil flows: see StressDiffusion.
struct StressDiffusionView {
  const std::int32_t* soil;   ///< and ghost; particles of one number share their stress, those below 0 do not
  const double* stress;       ///< effective, and ghost that shares it, stress_size numbers each [Pa]
  const double* diffusivity;  ///< D dt of the last step, and ghost; 0 where nothing shears [m2]
  double most;                ///< of the mean D dt of two particles [m2]
  std::uint8_t* near;         ///< 1 where D is not 0 at a particle or one that shares its stress
  const double* correction;   ///< L by the soil alone, a matrix each, column by column
  double* gradient;           ///< of the stress along each axis, and ghost, stress_size numbers each [Pa/m]
  double* change;             ///< stress_size numbers each [Pa]
};

template <class Space>
struct ConsistentArraysIn {
  ReferenceViewIn<Space> reference;
  MotionViewIn<Space> motion;
  SoilStateViewIn<Space> state;
  FluxViewIn<Space> fluxes;
  StabilisationView control;
  FlowView flow;
  StressDiffusionView diffusion;
  double gravity[Space::dim];  ///< [m/s2]
};

/// What the loops find out on their way.
struct LargestChange {
  double strain = 0;                          ///< |F - I|
  double speed_squared = 0;                   ///< [m2/s2]
  double plastic_work = 0, viscous_work = 0;  ///< sums, dissipated where soil flows [J/m]
};

/// One tile of particles each.
template <class Space>
struct ConsistentKernelsIn {
  /// dF/dt, gradient_size numbers each, written for the whole tile.
  void (*rates)(const ConsistentArraysIn<Space>&, std::int32_t tile, double* out);
  /// Carries F, the stress and the density over a step dt [s] and writes flux, records and P.
  void (*strain)(const ConsistentArraysIn<Space>&, std::int32_t tile, double dt, LargestChange&);
  /// Accelerations with gravity, a vector each for all particles [m/s2].
  void (*accelerate)(const ConsistentArraysIn<Space>&, std::int32_t tile, double* out);
  /// Where soil flows: which particles are near to soil that shears, and the gradients of their stress.
  void (*stress_gradients)(const ConsistentArraysIn<Space>&, std::int32_t tile);
  /// What their stress changes by as it diffuses, from the gradients of all.
  void (*diffuse)(const ConsistentArraysIn<Space>&, std::int32_t tile);
};

using ReferenceView = ReferenceViewIn<Plane>;
using ConsistentArrays = ConsistentArraysIn<Plane>;
using ConsistentKernels = ConsistentKernelsIn<Plane>;

/// Those compiled for these vector units, which the program must have.
const ConsistentKernels& consistent_kernels(VectorUnits units);

}  // namespace porosph
