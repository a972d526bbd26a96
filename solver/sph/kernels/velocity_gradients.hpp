// dF/dt of a tile of particles. For the kernels only, which are compiled for each kind of vector units.
#pragma once

#include "solver/sph/kernels/tile.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// sum_b (v_b - v_a) (x) G_ab of a stretch.
void shared_rates(const ConsistentArrays& c, const PairStencils::Piece& piece, std::int32_t first, Row* out) {
  const PairStencils& s = *c.reference.stencils;
  const PairStencils::Stretch stretch = s.stretches[piece.stretch];
  const std::int32_t* offset = s.offset.data();
  const PairGeometry* g = s.shared.data();
  by_vectors(piece, stretch, [&](std::int32_t a) {
    const double *vx = c.motion.velocity[0] + a, *vy = c.motion.velocity[1] + a;
    const PairGeometry own = g[stretch.pairs];
    const Vector x = load(vx), y = load(vy);
    Vector sum_xx = -own.x * x, sum_xy = -own.y * x, sum_yx = -own.x * y, sum_yy = -own.y * y;
    for (std::int32_t k = stretch.pairs + 1; k < stretch.pairs_end; ++k) {
      const Vector bx = load(vx + offset[k]), by = load(vy + offset[k]);
      sum_xx += g[k].x * bx, sum_xy += g[k].y * bx;
      sum_yx += g[k].x * by, sum_yy += g[k].y * by;
    }
    store(out[xx].of(a, first), sum_xx), store(out[xy].of(a, first), sum_xy);
    store(out[yx].of(a, first), sum_yx), store(out[yy].of(a, first), sum_yy);
  });
}

/// The same of a particle with a list of its own. Two sums of each: an addition need not wait for the one
/// before.
template <class Real>
inline void own_rates(const ConsistentArrays& c, const PairGeometryIn<Real>* g, std::int32_t a,
                      std::int32_t first, Row* out) {
  const PairStencils& s = *c.reference.stencils;
  const std::int32_t* index = s.index.data();
  const auto velocity = [&](std::int32_t b) {
    return *reinterpret_cast<const Pair*>(reinterpret_cast<const double*>(c.fluxes.records + b) +
                                          velocity_lane);
  };
  std::int64_t k = s.begin[a];
  const std::int64_t last = s.begin[a + 1];
  const Pair mine = velocity(a);
  const PairGeometry sum = sum_of(g, k, last);
  Pair x = -sum.x * mine, y = -sum.y * mine, x2{}, y2{};
  for (++k; k + 1 < last; k += 2) {
    const Pair v = velocity(index[k]), v2 = velocity(index[k + 1]);
    x += v * double{g[k].x}, x2 += v2 * double{g[k + 1].x};
    y += v * double{g[k].y}, y2 += v2 * double{g[k + 1].y};
  }
  if (k < last) x += velocity(index[k]) * double{g[k].x}, y += velocity(index[k]) * double{g[k].y};
  x += x2, y += y2;
  *out[xx].of(a, first) = x[0], *out[xy].of(a, first) = y[0];
  *out[yx].of(a, first) = x[1], *out[yy].of(a, first) = y[1];
}

/// What closed gradients add: sum_b (v_b - v_a) (x) w_ab (kappa_b - kappa_a).
void add_closing_rates(const ConsistentArrays& c, const TileRange& tile, Row* rate) {
  const double *vx = c.motion.velocity[0], *vy = c.motion.velocity[1];
  for (std::int32_t a = tile.first; a < tile.last; ++a) {
    Pair x{}, y{};
    const Pair own = load_pair(c.reference.kappa, a);
    c.reference.stencils->for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      const Pair k = g.w * (load_pair(c.reference.kappa, b) - own);
      x += k * (vx[b] - vx[a]), y += k * (vy[b] - vy[a]);
    });
    *rate[xx].of(a, tile.first) += x[0], *rate[xy].of(a, tile.first) += x[1];
    *rate[yx].of(a, tile.first) += y[0], *rate[yy].of(a, tile.first) += y[1];
  }
}

/// dF/dt = sum_b V_b (v_b - v_a) (x) L_a grad W_ab.
inline void tile_rates(const ConsistentArrays& c, const TileRange& tile, Row* rate) {
  const bool single = !c.reference.stencils->own_single.empty();
  for (const PairStencils::Piece* piece = tile.piece; piece != tile.piece_end; ++piece) {
    if (piece->stretch != PairStencils::own_list)
      shared_rates(c, *piece, tile.first, rate);
    else if (single)
      for (std::int32_t a = piece->first; a < piece->last; ++a)
        own_rates(c, c.reference.stencils->own_single.data(), a, tile.first, rate);
    else
      for (std::int32_t a = piece->first; a < piece->last; ++a)
        own_rates(c, c.reference.stencils->own.data(), a, tile.first, rate);
  }
  const double *lxx = c.reference.correction[xx] + tile.first, *lxy = c.reference.correction[xy] + tile.first;
  const double *lyx = c.reference.correction[yx] + tile.first, *lyy = c.reference.correction[yy] + tile.first;
  const std::int32_t count = tile.last - tile.first;
#pragma omp simd
  for (std::int32_t i = 0; i < count; ++i) {
    const double axx = rate[xx].value[i], axy = rate[xy].value[i];
    const double ayx = rate[yx].value[i], ayy = rate[yy].value[i];
    rate[xx].value[i] = axx * lxx[i] + axy * lxy[i], rate[xy].value[i] = axx * lyx[i] + axy * lyy[i];
    rate[yx].value[i] = ayx * lxx[i] + ayy * lxy[i], rate[yy].value[i] = ayx * lyx[i] + ayy * lyy[i];
  }
  if (c.reference.kappa) add_closing_rates(c, tile, rate);
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
