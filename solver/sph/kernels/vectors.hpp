// As many numbers as the vector units take at once. For the kernels only, which are compiled for each kind.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

#if defined(__AVX512F__)
constexpr int width = 8;
#elif defined(__AVX__)
constexpr int width = 4;
#else
constexpr int width = 2;
#endif
using Vector = double __attribute__((vector_size(8 * width)));

inline Vector load(const double* p) {
  Vector v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
inline void store(double* p, const Vector& v) { __builtin_memcpy(p, &v, sizeof v); }

inline Vector all(double number) { return Vector{} + number; }

inline Vector gather(const double* p, const std::int32_t* index) {
  return [&]<int... lane>(std::integer_sequence<int, lane...>) { return Vector{p[index[lane]]...}; }
  (std::make_integer_sequence<int, width>{});
}

/// v > 0, to some units in the last place.
inline Vector inverse_square_root(const Vector& v) {
#if defined(__AVX512F__)
  Vector y = _mm512_maskz_rsqrt14_pd(0xff, v);  // 14 bits; each of Newton's steps doubles them
  for (int step = 0; step < 2; ++step) y += y * (0.5 - 0.5 * v * y * y);
  return y;
#else
  Vector root;
  for (int lane = 0; lane < width; ++lane) root[lane] = std::sqrt(v[lane]);
  return 1 / root;
#endif
}

inline double sum_of_lanes(const Vector& v) {
  double sum = 0;
  for (int lane = 0; lane < width; ++lane) sum += v[lane];
  return sum;
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
