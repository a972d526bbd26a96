// Compiled once for each kind of vector units, into a namespace of that name. Everything that it calls must
// be inlined: a function shared with other files could be linked in from here and be too wide for a
// processor.
#include "solver/sph/kernels/consistent_kernels.hpp"

#include <algorithm>

#include "solver/sph/kernels/material_step.hpp"
#include "solver/sph/kernels/velocity_gradients.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

void rates(const ConsistentArrays& c, std::int32_t number, double* out) {
  const TileRange tile = range_of(*c.reference.stencils, number);
  Row rate[4];
  tile_rates(c, tile, rate);
  for (std::int32_t i = 0; i < tile.last - tile.first; ++i)
    for (int k = 0; k < 4; ++k) out[4 * i + k] = rate[k].value[i];
}

void strain(const ConsistentArrays& c, std::int32_t number, double dt, LargestChange& largest) {
  const TileRange tile = range_of(*c.reference.stencils, number);
  Row rate[4], piola[4];
  tile_rates(c, tile, rate);
  const TileStep step(c, tile, rate, piola, dt);
  for_each_soil(c.state.soils, tile.first, tile.last,
                [&](std::int32_t from, std::int32_t to, const LawView& law, std::int32_t place) {
                  const std::int32_t first = from - tile.first, last = to - tile.first;
                  const double elastic = c.control.rate[&law - c.state.soils.laws];
                  LargestChange change;
                  if (law.kind == Laws::size)
                    change = external_step(c, step, first, last, law, elastic, place);
                  else
                    with_law(Laws{}, law.kind, [&]<class Law>() {
                      const auto stepped = [&]<Watch watch>() {
                        return step_of<Law, watch>(c, step, first, last, law, elastic, place);
                      };
                      change = step.viscosity                 ? stepped.template operator()<Watch::flow>()
                               : step.yields && law.may_yield ? stepped.template operator()<Watch::yielding>()
                                                              : stepped.template operator()<Watch::nothing>();
                    });
                  largest.strain = std::max(largest.strain, change.strain);
                  largest.speed_squared = std::max(largest.speed_squared, change.speed_squared);
                  largest.plastic_work += change.plastic_work, largest.viscous_work += change.viscous_work;
                });
  const FluxView& f = c.fluxes;
  for (std::int32_t a = tile.first; a < tile.last; ++a) {
    if (f.listed[a]) {
      double* q = reinterpret_cast<double*>(f.records + a);
      for (int k = 0; k < 4; ++k) q[k] = f.flux[k][a];
    }
    if (f.mirrored[a])
      for (int k = 0; k < 4; ++k) f.piola[4 * a + k] = piola[k].value[a - tile.first];
  }
}

enum : int { force_x, force_y, pressure_x, pressure_y };

/// sum_b (P_a L_a + P_b L_b) G_ab with the zero-energy term, and sum_b (p_b - p_a) G_ab, of a stretch.
/// `varies`: each particle has a viscosity of its own.
template <bool wet, bool varies>
void shared_sums(const ConsistentArrays& c, const PairStencils::Piece& piece, std::int32_t first, Row* out) {
  const PairStencils& s = *c.reference.stencils;
  const PairStencils::Stretch stretch = s.stretches[piece.stretch];
  const std::int32_t* offset = s.offset.data();
  const PairGeometry* g = s.shared.data();
  const double viscous = 2 * c.control.viscosity;
  by_vectors(piece, stretch, [&](std::int32_t a) {
    const double *qxx = c.fluxes.flux[xx] + a, *qxy = c.fluxes.flux[xy] + a, *qyx = c.fluxes.flux[yx] + a,
                 *qyy = c.fluxes.flux[yy] + a;
    const double *vx = c.motion.controlled[0] + a, *vy = c.motion.controlled[1] + a,
                 *pw = wet ? c.motion.pressure + a : nullptr;
    const PairGeometry own = g[stretch.pairs];
    const double own_w = viscous * own.w;
    const double* mu = varies ? c.flow.viscosity + a : nullptr;
    Vector fx = load(qxx) * own.x, fx2 = load(qxy) * own.y, fx3{};
    Vector fy = load(qyx) * own.x, fy2 = load(qyy) * own.y, fy3{};
    if (!varies) fx3 = -own_w * load(vx), fy3 = -own_w * load(vy);
    Vector px{}, py{};
    if (wet) px = -own.x * load(pw), py = -own.y * load(pw);
    for (std::int32_t k = stretch.pairs + 1; k < stretch.pairs_end; ++k) {
      const std::int32_t b = offset[k];
      const double gx = g[k].x, gy = g[k].y, w = viscous * g[k].w;
      fx += gx * load(qxx + b), fx2 += gy * load(qxy + b);
      fy += gx * load(qyx + b), fy2 += gy * load(qyy + b);
      if (varies) {
        const Vector both = g[k].w * (load(mu) + load(mu + b));
        fx3 += both * (load(vx + b) - load(vx)), fy3 += both * (load(vy + b) - load(vy));
      } else {
        fx3 += w * load(vx + b), fy3 += w * load(vy + b);
      }
      if (wet) {
        const Vector p = load(pw + b);
        px += gx * p, py += gy * p;
      }
    }
    store(out[force_x].of(a, first), fx + fx2 + fx3), store(out[force_y].of(a, first), fy + fy2 + fy3);
    if (wet) store(out[pressure_x].of(a, first), px), store(out[pressure_y].of(a, first), py);
  });
}

/// The same of a particle with a list of its own.
template <bool varies, class Real>
inline void own_sums(const ConsistentArrays& c, const PairGeometryIn<Real>* g, std::int32_t a,
                     std::int32_t first, Row* out) {
  const PairStencils& s = *c.reference.stencils;
  const Record* records = c.fluxes.records;
  const std::int32_t* index = s.index.data();
  std::int64_t k = s.begin[a];
  const std::int64_t last = s.begin[a + 1];
  const PairGeometry sum = sum_of(g, k, last);
  const double mu = varies ? records[a].q[viscosity_lane] : 0;
  // The weight of a pair's velocities, for both of its viscosities where they vary.
  const auto weight = [&](std::int64_t at, const Lanes& q) {
    return varies ? double{g[at].w} * (mu + q[viscosity_lane]) : double{g[at].w};
  };
  Lanes x{}, y{}, w{}, x2{}, y2{}, w2{};
  double weights = 0;
  for (++k; k + 1 < last; k += 2) {
    const Lanes q = records[index[k]].q, q2 = records[index[k + 1]].q;
    const double one = weight(k, q), two = weight(k + 1, q2);
    x += q * double{g[k].x}, x2 += q2 * double{g[k + 1].x};
    y += q * double{g[k].y}, y2 += q2 * double{g[k + 1].y};
    w += q * one, w2 += q2 * two;
    if (varies) weights += one + two;
  }
  if (k < last) {
    const Lanes q = records[index[k]].q;
    const double one = weight(k, q);
    x += q * double{g[k].x}, y += q * double{g[k].y}, w += q * one;
    if (varies) weights += one;
  }
  x += x2, y += y2, w += w2;
  const Lanes own = records[a].q;
  const double viscous = varies ? 1 : 2 * c.control.viscosity, sum_w = varies ? weights : sum.w;
  constexpr int v = velocity_lane, p = pressure_lane;
  *out[force_x].of(a, first) =
      x[xx] + y[xy] + own[xx] * sum.x + own[xy] * sum.y + viscous * (w[v] - own[v] * sum_w);
  *out[force_y].of(a, first) =
      x[yx] + y[yy] + own[yx] * sum.x + own[yy] * sum.y + viscous * (w[v + 1] - own[v + 1] * sum_w);
  *out[pressure_x].of(a, first) = x[p] - own[p] * sum.x;  // eq. (22)
  *out[pressure_y].of(a, first) = y[p] - own[p] * sum.y;
}

/// What closed gradients add: sum_b (P_a + P_b) w_ab (kappa_b - kappa_a) and, likewise, sum_b (p_b - p_a) ...
template <bool wet>
void add_closing_accelerations(const ConsistentArrays& c, const TileRange& tile, double* out) {
  for (std::int32_t a = tile.first; a < tile.last; ++a) {
    const double* own = c.fluxes.piola + 4 * static_cast<std::int64_t>(a);
    const Pair kappa = load_pair(c.reference.kappa, a);
    double fx = 0, fy = 0;
    Pair pressure{};
    c.reference.stencils->for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      const double* other = c.fluxes.piola + 4 * static_cast<std::int64_t>(b);
      const Pair k = g.w * (load_pair(c.reference.kappa, b) - kappa);
      fx += (own[xx] + other[xx]) * k[0] + (own[xy] + other[xy]) * k[1];
      fy += (own[yx] + other[yx]) * k[0] + (own[yy] + other[yy]) * k[1];
      if (wet) pressure += k * (c.motion.pressure[b] - c.motion.pressure[a]);
    });
    if (wet) {
      fx += c.state.deformation[yy][a] * pressure[0] - c.state.deformation[yx][a] * pressure[1];
      fy += c.state.deformation[xx][a] * pressure[1] - c.state.deformation[xy][a] * pressure[0];
    }
    out[2 * static_cast<std::int64_t>(a)] += fx / c.reference.density[a];
    out[2 * static_cast<std::int64_t>(a) + 1] += fy / c.reference.density[a];
  }
}

template <bool wet, bool varies>
void accelerate_tile(const ConsistentArrays& c, std::int32_t number, double* out) {
  const TileRange tile = range_of(*c.reference.stencils, number);
  Row sum[4];
  const bool single = !c.reference.stencils->own_single.empty();
  for (const PairStencils::Piece* piece = tile.piece; piece != tile.piece_end; ++piece) {
    if (piece->stretch != PairStencils::own_list)
      shared_sums<wet, varies>(c, *piece, tile.first, sum);
    else if (single)
      for (std::int32_t a = piece->first; a < piece->last; ++a)
        own_sums<varies>(c, c.reference.stencils->own_single.data(), a, tile.first, sum);
    else
      for (std::int32_t a = piece->first; a < piece->last; ++a)
        own_sums<varies>(c, c.reference.stencils->own.data(), a, tile.first, sum);
  }
  const std::int32_t first = tile.first, count = tile.last - tile.first;
  const double *fxx = c.state.deformation[xx] + first, *fxy = c.state.deformation[xy] + first;
  const double *fyx = c.state.deformation[yx] + first, *fyy = c.state.deformation[yy] + first;
  const double *lxx = c.reference.correction[xx] + first, *lxy = c.reference.correction[xy] + first;
  const double *lyx = c.reference.correction[yx] + first, *lyy = c.reference.correction[yy] + first;
  const double *rho = c.reference.density + first, *fill = c.reference.fill + first;
  const double gx = c.gravity[0], gy = c.gravity[1];
  double* result = out + 2 * static_cast<std::int64_t>(first);
#pragma omp simd
  for (std::int32_t i = 0; i < count; ++i) {
    const double per_fill = 1 / fill[i];
    double fx = per_fill * sum[force_x].value[i], fy = per_fill * sum[force_y].value[i];
    if (wet) {
      const double px = sum[pressure_x].value[i], py = sum[pressure_y].value[i];
      const double x = lxx[i] * px + lxy[i] * py, y = lyx[i] * px + lyy[i] * py;
      fx += fyy[i] * x - fyx[i] * y, fy += fxx[i] * y - fxy[i] * x;  // J F^-T, the cofactors of F
    }
    const double per_mass = 1 / rho[i];
    result[2 * i] = fx * per_mass + gx, result[2 * i + 1] = fy * per_mass + gy;
  }
  if (c.reference.kappa) add_closing_accelerations<wet>(c, tile, out);
}

void accelerate(const ConsistentArrays& c, std::int32_t tile, double* out) {
  const auto with = [&]<bool varies>() {
    c.motion.pressure ? accelerate_tile<true, varies>(c, tile, out)
                      : accelerate_tile<false, varies>(c, tile, out);
  };
  c.flow.viscosity ? with.template operator()<true>() : with.template operator()<false>();
}

}  // namespace

extern const ConsistentKernels consistent_kernels;
const ConsistentKernels consistent_kernels = {rates, strain, accelerate};

}  // namespace porosph::POROSPH_VECTOR_UNITS
