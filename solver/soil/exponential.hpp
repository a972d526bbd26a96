// The exponential in plain arithmetic: laws run inside loops of vector code.
#pragma once

namespace porosph {

/// exp(x) - 1 to 1e-14 of its value, for |x| <= 40; beyond that the value at +-40.
[[gnu::always_inline]] inline double exponential_less_one(double x) {
  const double above = x > -40 ? x : -40.0, y = (above < 40 ? above : 40.0) / 64;
  double sum = 1;  // Taylor's series of (exp(y) - 1) / y, |y| <= 0.625
#pragma GCC unroll 14
  for (int k = 15; k > 1; --k) sum = 1 + y * (1.0 / k) * sum;
  double less_one = y * sum;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) less_one *= 2 + less_one;
  return less_one;
}
/// exp(x), likewise.
[[gnu::always_inline]] inline double exponential(double x) { return 1 + exponential_less_one(x); }

}  // namespace porosph
