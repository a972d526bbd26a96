// Kinematics and stress of a block of particles at once, as vector code.
#pragma once

#include <cmath>
#include <cstddef>

#include "solver/constitutive/linear_elastic.hpp"
#include "solver/stabilisation/bulk_viscosity.hpp"

namespace porosph {

/// What the consistent form needs of some particles, one array per number. Unused places hold the harmless
/// defaults.
struct MaterialBlock {
  static constexpr std::size_t size = 32;
  using Row = double[size];

  alignas(64) Row rate[4];         ///< dF/dt: xx, xy, yx, yy [1/s]
  alignas(64) Row deformation[4];  ///< F
  alignas(64) Row stress[4];       ///< effective: xx, yy, zz, xy [Pa]
  alignas(64) Row shear_modulus, bulk_modulus, reference_density;
  alignas(64) Row no_tension;  ///< 1 where mean tension is cut off, else 0
  alignas(64) Row density;     ///< out [kg/m3]
  alignas(64) Row piola[4];    ///< out: P = J (sigma' + q I) F^-T, q the bulk viscous stress [Pa]

  MaterialBlock() {
    for (std::size_t i = 0; i < size; ++i) {
      for (int c = 0; c < 4; ++c) rate[c][i] = stress[c][i] = deformation[c][i] = no_tension[i] = 0;
      deformation[0][i] = deformation[3][i] = shear_modulus[i] = bulk_modulus[i] = reference_density[i] = 1;
    }
  }

  /// Advances F, the stress and the density by dt [s]; dt = 0 evaluates P where things stand.
  /// `bulk_h` is the bulk viscosity's strength times h [m].
  void advance(double dt, double bulk_h) {
#pragma omp simd
    for (std::size_t i = 0; i < size; ++i) {
      const double rxx = rate[0][i], rxy = rate[1][i], ryx = rate[2][i], ryy = rate[3][i];
      const double half = 0.5 * dt;
      const double mxx = deformation[0][i] + half * rxx, mxy = deformation[1][i] + half * rxy;
      const double myx = deformation[2][i] + half * ryx, myy = deformation[3][i] + half * ryy;
      const double scale =
          1 / (mxx * myy - mxy * myx);  // mid-step dv/dx = dF/dt F^-1 (Hughes and Winget 1980)
      const Gradient gradient((rxx * myy - rxy * myx) * scale, (rxy * mxx - rxx * mxy) * scale,
                              (ryx * myy - ryy * myx) * scale, (ryy * mxx - ryx * mxy) * scale);
      const LinearElastic soil{shear_modulus[i], bulk_modulus[i], no_tension[i] != 0};
      const Stress s = soil.update({stress[0][i], stress[1][i], stress[2][i], stress[3][i]}, gradient, dt);
      stress[0][i] = s.xx, stress[1][i] = s.yy, stress[2][i] = s.zz, stress[3][i] = s.xy;

      const double fxx = deformation[0][i] + dt * rxx, fxy = deformation[1][i] + dt * rxy;
      const double fyx = deformation[2][i] + dt * ryx, fyy = deformation[3][i] + dt * ryy;
      deformation[0][i] = fxx, deformation[1][i] = fxy, deformation[2][i] = fyx, deformation[3][i] = fyy;
      density[i] = reference_density[i] / (fxx * fyy - fxy * fyx);

      const double rho_c_h = std::sqrt(soil.constrained_modulus() * density[i]);
      const double q = bulk_viscosity(bulk_h, rho_c_h, gradient.trace());
      const double txx = s.xx + q, tyy = s.yy + q;  // J F^-T is the cofactor matrix of F
      piola[0][i] = txx * fyy - s.xy * fxy, piola[1][i] = s.xy * fxx - txx * fyx;
      piola[2][i] = s.xy * fyy - tyy * fxy, piola[3][i] = tyy * fxx - s.xy * fyx;
    }
  }
};

}  // namespace porosph
