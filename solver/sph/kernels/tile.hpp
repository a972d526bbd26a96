// A tile of particles and how its sums run. For the kernels only, which are compiled for each kind of vector
// units.
#pragma once

#include <algorithm>
#include <cstdint>

#include "solver/sph/kernels/consistent_kernels.hpp"
#include "solver/sph/kernels/vectors.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

constexpr int xx = 0, xy = 1, yx = 2, yy = 3;

/// A number of each of a tile's particles. Stretches are summed in whole vectors, which may reach over the
/// tile's ends.
struct Row {
  static constexpr int slack = PairStencils::shortest;
  alignas(64) double numbers[slack + PairStencils::tile + slack];
  double* value = numbers + slack;
  double* of(std::int32_t a, std::int32_t first) { return value + (a - first); }
};

inline Pair load_pair(const double* p, std::int32_t a) {
  Pair v;
  __builtin_memcpy(&v, p + 2 * static_cast<std::int64_t>(a), sizeof v);
  return v;
}

struct TileRange {
  std::int32_t first, last;
  const PairStencils::Piece *piece, *piece_end;
};

inline TileRange range_of(const PairStencils& s, std::int32_t tile) {
  const std::int32_t first = tile * PairStencils::tile;
  return {first, std::min(first + PairStencils::tile, static_cast<std::int32_t>(s.stretch_of.size())),
          s.pieces.data() + s.first_piece[tile], s.pieces.data() + s.first_piece[tile + 1]};
}

/// Calls use(a) with `a` the first of each `width` consecutive particles of the stretch that cover the piece.
template <class Use>
inline void by_vectors(const PairStencils::Piece& piece, const PairStencils::Stretch& stretch, Use&& use) {
  static_assert(width <= PairStencils::shortest);
  for (std::int32_t a = piece.first; a < piece.last; a += width)
    use(std::max(stretch.first, std::min(a, piece.last - width)));
}

/// Sums over a list's neighbours: stored with it, or, where the pairs were rounded, summed again, so that
/// what is constant still has no gradient.
inline PairGeometry sum_of(const PairGeometry* g, std::int64_t first, std::int64_t) { return g[first]; }
inline PairGeometry sum_of(const SinglePairGeometry* g, std::int64_t first, std::int64_t last) {
  PairGeometry sum{0, 0, 0};
  for (std::int64_t k = first + 1; k < last; ++k) sum.x += g[k].x, sum.y += g[k].y, sum.w += g[k].w;
  return sum;
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
