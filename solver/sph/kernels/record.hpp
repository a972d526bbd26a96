// One particle's values as one cache line.
#pragma once

namespace porosph {

/// The compiler maps it to AVX-512, AVX2 or SSE2 as the target allows.
using Lanes = double __attribute__((vector_size(64)));

/// A plane vector's two numbers.
using Pair = double __attribute__((vector_size(16)));

/// Loaded whole for each neighbour and multiplied with the pair's gradient: no number is gathered alone.
struct alignas(64) Record {
  Lanes q{};
};

}  // namespace porosph
