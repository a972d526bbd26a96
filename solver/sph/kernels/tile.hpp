// A tile of particles and how its sums run. For the kernels only, which are compiled for each kind of vector
// units.
#pragma once

#include <algorithm>
#include <cstdint>

#include "solver/sph/kernels/consistent_kernels.hpp"
#include "solver/sph/kernels/vectors.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// A number of each of a tile's particles. Stretches are summed in whole vectors, which may reach over the
/// tile's ends.
struct Row {
  static constexpr int slack = PairStencils::shortest;
  alignas(64) double numbers[slack + PairStencils::tile + slack];
  double* value = numbers + slack;
  double* of(std::int32_t a, std::int32_t first) { return value + (a - first); }
};

/// The components of a particle's vector; a vector in space fills three of four.
template <int dim>
struct Components;
template <>
struct Components<2> {
  using Type = double __attribute__((vector_size(16)));
};
template <>
struct Components<3> {
  using Type = double __attribute__((vector_size(32)));
};

/// The vector of particle a, from an array that holds those of all, one after the other.
template <int dim>
inline typename Components<dim>::Type vector_of(const double* p, std::int64_t a) {
  typename Components<dim>::Type v{};
  __builtin_memcpy(&v, p + dim * a, dim * sizeof(double));
  return v;
}

/// G's component along axis d.
template <class Real>
inline Real along(const PairGeometryIn<Real, 2>& g, int d) {
  return d == 0 ? g.x : g.y;
}
template <class Real>
inline Real along(const PairGeometryIn<Real, 3>& g, int d) {
  return d == 0 ? g.x : d == 1 ? g.y : g.z;
}

/// Particles first to last - 1.
struct TileRange {
  std::int32_t number, first, last;
};

template <class Space>
inline TileRange range_of(const PairStencilsIn<Space>& s, std::int32_t tile) {
  const std::int32_t first = tile * s.tile;
  return {tile, first, std::min(first + s.tile, static_cast<std::int32_t>(s.stretch_of.size()))};
}

/// Calls shared(piece) for each piece of the tile that lies in a stretch, and own(pairs, a) for each particle
/// with a list of its own, `pairs` being those of all lists.
template <class Space, class Shared, class Own>
inline void for_each_piece(const PairStencilsIn<Space>& s, const TileRange& tile, Shared&& shared,
                           Own&& own) {
  const bool single = !s.own_single.empty();
  const auto* end = s.pieces.data() + s.first_piece[tile.number + 1];
  for (const auto* piece = s.pieces.data() + s.first_piece[tile.number]; piece != end; ++piece) {
    if (piece->stretch != s.own_list)
      shared(*piece);
    else if (single)
      for (std::int32_t a = piece->first; a < piece->last; ++a) own(s.own_single.data(), a);
    else
      for (std::int32_t a = piece->first; a < piece->last; ++a) own(s.own.data(), a);
  }
}

/// Calls use(a) with `a` the first of each `width` consecutive particles of the stretch that cover the piece.
template <class Piece, class Stretch, class Use>
inline void by_vectors(const Piece& piece, const Stretch& stretch, Use&& use) {
  static_assert(width <= PairStencils::shortest);
  for (std::int32_t a = piece.first; a < piece.last; a += width)
    use(std::max(stretch.first, std::min(a, piece.last - width)));
}

/// Adds the pairs of particle a's own list to two sums in turn: an addition need not wait for the one before.
template <class Space, class Sums, class Add>
[[gnu::always_inline]] inline void add_by_twos(const PairStencilsIn<Space>& s, std::int32_t a,
                                               Sums (&sums)[2], Add&& add) {
  std::int64_t k = s.begin[a] + 1;
  const std::int64_t last = s.begin[a + 1];
  for (; k + 1 < last; k += 2) add(k, sums[0]), add(k + 1, sums[1]);
  if (k < last) add(k, sums[0]);
}

/// Sums over a list's neighbours: stored with it, or, where the pairs were rounded, summed again, so that
/// what is constant still has no gradient.
template <int dim>
inline PairGeometryIn<double, dim> sum_of(const PairGeometryIn<double, dim>* g, std::int64_t first,
                                          std::int64_t) {
  return g[first];
}
template <int dim>
inline PairGeometryIn<double, dim> sum_of(const PairGeometryIn<float, dim>* g, std::int64_t first,
                                          std::int64_t last) {
  PairGeometryIn<double, dim> sum{};
  for (std::int64_t k = first + 1; k < last; ++k) {
    sum.x += g[k].x, sum.y += g[k].y, sum.w += g[k].w;
    if constexpr (dim == 3) sum.z += g[k].z;
  }
  return sum;
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
