// Eight numbers that the hot loops load, multiply and add at once.
#pragma once

#include <vector>

#include "solver/tensor.hpp"

namespace porosph {

/// One cache line of a particle's values. The compiler maps it to AVX-512, AVX2 or SSE2 as the target allows.
using Lanes = double __attribute__((vector_size(64)));

/// A plane vector's two numbers.
using Pair = double __attribute__((vector_size(16)));
inline Pair load_pair(const double* p) { return Pair{p[0], p[1]}; }

struct alignas(64) Record {
  Lanes q{};
};

/// A pair's stored kernel gradient, V_b grad_a W_ab (corrected or not, as the motion equation needs it)
/// [1/m].
struct PairGradient {
  double x, y;
};

/// sum_b q_b G_ab: the sums that all forms of the motion equation are made of.
struct PairSums {
  Lanes x{}, y{};
};

}  // namespace porosph
