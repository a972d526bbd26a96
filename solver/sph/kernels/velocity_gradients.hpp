// dF/dt of a tile of particles. For the kernels only, which are compiled for each kind of vector units.
#pragma once

#include "solver/sph/kernels/matrices.hpp"
#include "solver/sph/kernels/tile.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// sum_b (v_b - v_a) (x) G_ab of a stretch.
template <class Space, class Piece>
void shared_rates(const ConsistentArraysIn<Space>& c, const Piece& piece, std::int32_t first, Row* out) {
  constexpr int dim = Space::dim;
  const auto& s = *c.reference.stencils;
  const auto stretch = s.stretches[piece.stretch];
  const std::int32_t* offset = s.offset.data();
  const auto* g = s.shared.data();
  by_vectors(piece, stretch, [&](std::int32_t a) {
    Vector sum[dim][dim];
    for (int i = 0; i < dim; ++i) {
      const Vector own = load(c.motion.velocity[i] + a);
      for (int j = 0; j < dim; ++j) sum[i][j] = -along(g[stretch.pairs], j) * own;
    }
    for (std::int32_t k = stretch.pairs + 1; k < stretch.pairs_end; ++k)
      for (int i = 0; i < dim; ++i) {
        const Vector other = load(c.motion.velocity[i] + a + offset[k]);
        for (int j = 0; j < dim; ++j) sum[i][j] += along(g[k], j) * other;
      }
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) store(out[dim * i + j].of(a, first), sum[i][j]);
  });
}

/// The same of a particle with a list of its own. Two sums of each: an addition need not wait for the one
/// before.
template <class Space, class Pair>
inline void own_rates(const ConsistentArraysIn<Space>& c, const Pair* g, std::int32_t a, std::int32_t first,
                      Row* out) {
  constexpr int dim = Space::dim;
  using Components = typename Components<dim>::Type;
  const auto& s = *c.reference.stencils;
  const std::int32_t* index = s.index.data();
  const auto velocity = [&](std::int32_t b) {
    return vector_of<dim>(c.fluxes.records[b].q + RecordIn<Space>::velocity, 0);
  };
  std::int64_t k = s.begin[a];
  const std::int64_t last = s.begin[a + 1];
  const Components mine = velocity(a);
  const auto own = sum_of(g, k, last);
  Components sum[dim], second[dim]{};
  for (int j = 0; j < dim; ++j) sum[j] = -along(own, j) * mine;
  for (++k; k + 1 < last; k += 2) {
    const Components v = velocity(index[k]), v2 = velocity(index[k + 1]);
    for (int j = 0; j < dim; ++j)
      sum[j] += v * double{along(g[k], j)}, second[j] += v2 * double{along(g[k + 1], j)};
  }
  if (k < last) {
    const Components v = velocity(index[k]);
    for (int j = 0; j < dim; ++j) sum[j] += v * double{along(g[k], j)};
  }
  for (int j = 0; j < dim; ++j) {
    sum[j] += second[j];
    for (int i = 0; i < dim; ++i) *out[dim * i + j].of(a, first) = sum[j][i];
  }
}

/// What closed gradients add: sum_b (v_b - v_a) (x) w_ab (kappa_b - kappa_a), of a stretch.
template <class Space, class Piece>
void shared_closing_rates(const ConsistentArraysIn<Space>& c, const Piece& piece, std::int32_t first,
                          Row* out) {
  constexpr int dim = Space::dim;
  const auto& s = *c.reference.stencils;
  const auto stretch = s.stretches[piece.stretch];
  by_vectors(piece, stretch, [&](std::int32_t a) {
    Vector sum[dim][dim]{}, change[dim];
    for (std::int32_t k = stretch.pairs + 1; k < stretch.pairs_end; ++k) {
      const std::int32_t b = a + s.offset[k];
      for (int j = 0; j < dim; ++j)
        change[j] = s.shared[k].w * (load(c.reference.kappa[j] + b) - load(c.reference.kappa[j] + a));
      for (int i = 0; i < dim; ++i) {
        const Vector v = load(c.motion.velocity[i] + b) - load(c.motion.velocity[i] + a);
        for (int j = 0; j < dim; ++j) sum[i][j] += v * change[j];
      }
    }
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) store(out[dim * i + j].of(a, first), sum[i][j]);
  });
}

/// The same of a particle with a list of its own.
template <class Space, class Pair>
inline void own_closing_rates(const ConsistentArraysIn<Space>& c, const Pair* g, std::int32_t a,
                              std::int32_t first, Row* out) {
  constexpr int dim = Space::dim;
  const auto& s = *c.reference.stencils;
  double sum[2][dim][dim]{};
  add_by_twos(s, a, sum, [&](std::int64_t k, double(&to)[dim][dim]) {
    const std::int32_t b = s.index[k];
    for (int j = 0; j < dim; ++j) {
      const double change = g[k].w * (c.reference.kappa[j][b] - c.reference.kappa[j][a]);
      for (int i = 0; i < dim; ++i) to[i][j] += change * (c.motion.velocity[i][b] - c.motion.velocity[i][a]);
    }
  });
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) *out[dim * i + j].of(a, first) = sum[0][i][j] + sum[1][i][j];
}

template <class Space>
void add_closing_rates(const ConsistentArraysIn<Space>& c, const TileRange& tile, Row* rate) {
  Row closing[matrix_size<Space>];
  for_each_piece(
      *c.reference.stencils, tile,
      [&](const auto& piece) { shared_closing_rates(c, piece, tile.first, closing); },
      [&](const auto* pairs, std::int32_t a) { own_closing_rates(c, pairs, a, tile.first, closing); });
  for (int k = 0; k < matrix_size<Space>; ++k)
    for (std::int32_t i = 0; i < tile.last - tile.first; ++i) rate[k].value[i] += closing[k].value[i];
}

/// Entry i of the rows times L^T. In a function of its own: see particle_step.
template <class Space>
[[gnu::always_inline]] inline void correct(double* const* rows, const double* const* correction,
                                           std::int32_t i) {
  put(rows, i, product(matrix_at<Space>(rows, i), transposed(matrix_at<Space>(correction, i))));
}

/// dF/dt = sum_b V_b (v_b - v_a) (x) L_a grad W_ab, and v_x / X in the hoop.
template <class Space>
inline void tile_rates(const ConsistentArraysIn<Space>& c, const TileRange& tile, Row* rate) {
  for_each_piece(
      *c.reference.stencils, tile, [&](const auto& piece) { shared_rates(c, piece, tile.first, rate); },
      [&](const auto* pairs, std::int32_t a) { own_rates(c, pairs, a, tile.first, rate); });
  const double* correction[matrix_size<Space>];
  double* rows[matrix_size<Space>];
  for (int k = 0; k < matrix_size<Space>; ++k)
    correction[k] = c.reference.correction[k] + tile.first, rows[k] = rate[k].value;
  const std::int32_t count = tile.last - tile.first;
#pragma omp simd
  for (std::int32_t i = 0; i < count; ++i) correct<Space>(rows, correction, i);
  if (c.reference.kappa[0]) add_closing_rates(c, tile, rate);
  if constexpr (has_hoop<Space>)
    for (std::int32_t a = tile.first; a < tile.last; ++a)
      *rate[matrix_size<Space>].of(a, tile.first) = c.motion.velocity[0][a] / c.reference.radius[a];
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
