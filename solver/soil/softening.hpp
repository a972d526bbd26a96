// How strength falls from its peak to its residual value with plastic strain.
#pragma once

namespace porosph {

/// exp(-x) for x >= 0 to 1e-12 of its value, in plain arithmetic: laws run inside loops of vector code.
/// Below exp(-40) it is 0 for what it is used for.
[[gnu::always_inline]] inline double decay(double x) {
  const double y = (x < 40 ? x : 40) / 64;
  double sum = 1;  // Taylor's series of exp(-y), y <= 0.625
#pragma GCC unroll 15
  for (int k = 15; k > 0; --k) sum = 1 - y * (1.0 / k) * sum;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) sum *= sum;
  return sum;
}

/// Share of the peak's excess over the residual strength that plastic strain has left. Both rates are per
/// plastic strain of a particle; where strain localises in a band as wide as a few particles, they have to
/// be scaled with the spacing, or results depend on it.
struct Softening {
  double exponential = 0;  ///< rate of exp(-rate strain) [-]
  double linear = 0;       ///< rate of 1 - rate strain [-]

  bool present() const { return exponential > 0 || linear > 0; }
  double left(double plastic_strain) const {
    const double straight = 1 - linear * plastic_strain;
    return (straight > 0 ? straight : 0) * decay(exponential * plastic_strain);
  }
};

}  // namespace porosph
