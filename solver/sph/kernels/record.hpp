// One particle's values as whole cache lines.
#pragma once

#include "solver/space/tensor.hpp"

namespace porosph {

/// The compiler maps it to AVX-512, AVX2 or SSE2 as the target allows.
using Lanes = double __attribute__((vector_size(64)));

/// Flux, pore pressure, viscosity and velocity of a particle. Loaded whole for each neighbour and multiplied
/// with the pair's gradient: no number is gathered alone.
template <class Space>
struct alignas(64) RecordIn {
  static constexpr int pressure = Space::dim * Space::dim, viscosity = pressure + 1, velocity = viscosity + 1;
  static constexpr int lines = (velocity + Space::dim + 7) / 8;
  double q[8 * lines] = {};  ///< the flux comes first, row by row
};

using Record = RecordIn<Plane>;
static_assert(sizeof(Record) == 64);

}  // namespace porosph
