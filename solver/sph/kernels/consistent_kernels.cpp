// Compiled once for each kind of vector units, into a namespace of that name. Everything that it calls must
// be inlined: a function shared with other files could be linked in from here and be too wide for a
// processor.
#include "solver/sph/kernels/consistent_kernels.hpp"

#include <algorithm>
#include <cmath>

#include "solver/sph/kernels/mid_step.hpp"
#include "solver/sph/kernels/soil_step.hpp"
#include "solver/sph/kernels/vectors.hpp"
#include "solver/sph/stabilisation/bulk_viscosity.hpp"

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

/// Sums over a list's neighbours: stored with it, or, where the pairs were rounded, summed again, so that what
/// is constant still has no gradient.
inline PairGeometry sum_of(const PairGeometry* g, std::int64_t first, std::int64_t) { return g[first]; }
inline PairGeometry sum_of(const SinglePairGeometry* g, std::int64_t first, std::int64_t last) {
  PairGeometry sum{0, 0, 0};
  for (std::int64_t k = first + 1; k < last; ++k) sum.x += g[k].x, sum.y += g[k].y, sum.w += g[k].w;
  return sum;
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

void rates(const ConsistentArrays& c, std::int32_t number, double* out) {
  const TileRange tile = range_of(*c.reference.stencils, number);
  Row rate[4];
  tile_rates(c, tile, rate);
  for (std::int32_t i = 0; i < tile.last - tile.first; ++i)
    for (int k = 0; k < 4; ++k) out[4 * i + k] = rate[k].value[i];
}

/// By value: std::max keeps the loop from becoming vector code.
inline double larger(double a, double b) { return a > b ? a : b; }

/// The arrays of a tile, each from the tile's first particle on, and what a step does with them. All of it
/// must be inlined, or the loops over particles do not become vector code.
struct TileStep {
  TileStep(const ConsistentArrays& c, const TileRange& tile, const Row* rates, Row* piola_rows, double step)
      : particle(tile.first),
        vx(c.motion.velocity[0] + tile.first),
        vy(c.motion.velocity[1] + tile.first),
        reference_density(c.reference.density + tile.first),
        fill(c.reference.fill + tile.first),
        stress(c.state.stress + 4 * tile.first),
        density(c.state.density + tile.first),
        yields(c.state.yields ? c.state.yields + tile.first : nullptr),
        mu(c.control.viscosity),
        bulk_length(c.control.bulk_length),
        dt(step),
        half(0.5 * step) {
    for (int k = 0; k < 4; ++k) {
      rate[k] = rates[k].value, piola[k] = piola_rows[k].value;
      deformation[k] = c.state.deformation[k] + tile.first;
      correction[k] = c.reference.correction[k] + tile.first;
      flux[k] = c.fluxes.flux[k] + tile.first;
    }
  }

  /// Velocity gradient at the middle of the step.
  [[gnu::always_inline]] Gradient gradient(std::int32_t i) const {
    const double rxx = rate[xx][i], rxy = rate[xy][i], ryx = rate[yx][i], ryy = rate[yy][i];
    return mid_step_gradient({rxx, rxy, ryx, ryy},
                             {deformation[xx][i] + half * rxx, deformation[xy][i] + half * rxy,
                              deformation[yx][i] + half * ryx, deformation[yy][i] + half * ryy});
  }
  [[gnu::always_inline]] Stress old_stress(std::int32_t i) const {
    return {stress[4 * i], stress[4 * i + 1], stress[4 * i + 2], stress[4 * i + 3]};
  }
  [[gnu::always_inline]] void store_stress(std::int32_t i, const Stress& s) const {
    stress[4 * i] = s.xx, stress[4 * i + 1] = s.yy, stress[4 * i + 2] = s.zz, stress[4 * i + 3] = s.xy;
  }

  /// F and density after the step.
  struct Deformed {
    double xx, xy, yx, yy, density;
  };
  [[gnu::always_inline]] Deformed deform(std::int32_t i, double& strain, double& speed_squared) const {
    const double fxx = deformation[xx][i] + dt * rate[xx][i], fxy = deformation[xy][i] + dt * rate[xy][i];
    const double fyx = deformation[yx][i] + dt * rate[yx][i], fyy = deformation[yy][i] + dt * rate[yy][i];
    deformation[xx][i] = fxx, deformation[xy][i] = fxy, deformation[yx][i] = fyx, deformation[yy][i] = fyy;
    const double rho = reference_density[i] / (fxx * fyy - fxy * fyx);
    density[i] = rho;
    strain = larger(
        strain, larger(larger(std::abs(fxx - 1), std::abs(fyy - 1)), larger(std::abs(fxy), std::abs(fyx))));
    speed_squared = larger(speed_squared, vx[i] * vx[i] + vy[i] * vy[i]);
    return {fxx, fxy, fyx, fyy, rho};
  }

  /// dF/dt + k (F - I), which the zero-energy control acts on.
  [[gnu::always_inline]] Gradient controlled(std::int32_t i, const Deformed& f, double k) const {
    return {rate[xx][i] + k * (f.xx - 1), rate[xy][i] + k * f.xy, rate[yx][i] + k * f.yx,
            rate[yy][i] + k * (f.yy - 1)};
  }

  /// P, and the flux fill P L less the zero-energy control, of the stress `s`.
  [[gnu::always_inline]] void write_flux(std::int32_t i, const Stress& s, const Deformed& f, double modulus,
                                         double dilatation, const Gradient& control) const {
    const double q = bulk_viscosity(bulk_length, std::sqrt(modulus * f.density), dilatation);
    const double txx = s.xx + q, tyy = s.yy + q;  // J F^-T is the cofactor matrix of F
    const double pxx = txx * f.yy - s.xy * f.xy, pxy = s.xy * f.xx - txx * f.yx;
    const double pyx = s.xy * f.yy - tyy * f.xy, pyy = tyy * f.xx - s.xy * f.yx;
    piola[xx][i] = pxx, piola[xy][i] = pxy, piola[yx][i] = pyx, piola[yy][i] = pyy;
    const double sxx = fill[i] * correction[xx][i], sxy = fill[i] * correction[xy][i],
                 syx = fill[i] * correction[yx][i], syy = fill[i] * correction[yy][i];
    flux[xx][i] = pxx * sxx + pxy * syx - mu * control.xx;
    flux[xy][i] = pxx * sxy + pxy * syy - mu * control.xy;
    flux[yx][i] = pyx * sxx + pyy * syx - mu * control.yx;
    flux[yy][i] = pyx * sxy + pyy * syy - mu * control.yy;
  }

  std::int32_t particle;  ///< the tile's first
  const double *vx, *vy, *reference_density, *fill;
  double *stress, *density, *yields;
  double mu, bulk_length, dt, half;
  const double *rate[4], *correction[4];
  double *piola[4], *deformation[4], *flux[4];
};

/// 1 where the law's stress is not that of an elastic step, or else 0.
[[gnu::always_inline]] inline double departs(const Stress& s, const Stress& elastic) {
  const double off = std::abs(s.xx - elastic.xx) + std::abs(s.yy - elastic.yy) + std::abs(s.xy - elastic.xy);
  return off > 1e-9 * (std::abs(elastic.xx) + std::abs(elastic.yy) + std::abs(elastic.xy)) ? 1 : 0;
}

/// Particles first to last - 1 of the tile, which have this law. `elastic`: k of the control in this soil.
/// `watched`: writes down which of them yield.
template <SoilLaw Law, bool watched>
LargestChange material_step(const TileStep& tile, std::int32_t first, std::int32_t last, const LawView& view,
                            double elastic) {
  const TileStep t = tile;  // of this function's own: nothing that is written can be part of it
  const Law law = *static_cast<const Law*>(view.law);
  double* history[history_size<Law> + 1];
  for (std::size_t k = 0; k < history_size<Law>; ++k) history[k] = view.history[k] + t.particle;
  double strain = 0, speed_squared = 0;
#pragma omp simd reduction(max : strain, speed_squared)
  for (std::int32_t i = first; i < last; ++i) {
    const Gradient gradient = t.gradient(i);
    typename Law::History q = load_history<Law>(history, i);
    const Stress old = t.old_stress(i), s = law.step(old, gradient, t.dt, q);
    if (watched) t.yields[i] = departs(s, law.elastic_step(old, gradient, t.dt));
    store_history<Law>(history, i, q);
    t.store_stress(i, s);
    const TileStep::Deformed f = t.deform(i, strain, speed_squared);
    t.write_flux(i, s, f, law.constrained_modulus(s, q), gradient.trace(), t.controlled(i, f, elastic));
  }
  return {strain, speed_squared};
}

/// What a step at an interface does with the gradient of a particle's own side.
struct OwnSideStep {
  OwnSideStep(const ConsistentArrays& c, std::int32_t first_particle, std::int32_t place)
      : interface_stress(c.state.interface_stress + first_particle),
        along_x(c.state.own_sides.along[0] + place),
        along_y(c.state.own_sides.along[1] + place),
        elastic(c.state.own_sides.rate + place) {
    for (int k = 0; k < 16; ++k) a[k] = c.state.own_sides.gradient[k] + place;
    for (int k = 0; k < 4; ++k) tie[k] = c.state.own_sides.tie[k] + place;
  }

  /// A : m for the particle j of this stretch.
  [[gnu::always_inline]] Gradient own(std::int32_t j, double mxx, double mxy, double myx, double myy) const {
    return {a[0][j] * mxx + a[1][j] * mxy + a[2][j] * myx + a[3][j] * myy,
            a[4][j] * mxx + a[5][j] * mxy + a[6][j] * myx + a[7][j] * myy,
            a[8][j] * mxx + a[9][j] * mxy + a[10][j] * myx + a[11][j] * myy,
            a[12][j] * mxx + a[13][j] * mxy + a[14][j] * myx + a[15][j] * myy};
  }
  /// The own side's strain rate with the rotation of the sum.
  [[gnu::always_inline]] Gradient gradient(std::int32_t j, const Gradient& summed) const {
    const Gradient g = own(j, summed.xx, summed.xy, summed.yx, summed.yy);
    const double shear = 0.5 * (g.xy + g.yx), spin = 0.5 * (summed.yx - summed.xy);
    return {g.xx, shear - spin, shear + spin, g.yy};
  }
  /// Carries tau over the step and adds tau t (x) t to the stress. Soil that yields does not hold it: half of
  /// it goes in each step.
  [[gnu::always_inline]] Stress tied(std::int32_t j, const Stress& s, const Gradient& g, double dt,
                                     double yields) const {
    const double grown = dt * (tie[0][j] * g.xx + tie[1][j] * g.xy + tie[2][j] * g.yx + tie[3][j] * g.yy);
    const double tau = (1 - 0.5 * yields) * interface_stress[j] + (1 - yields) * grown;
    interface_stress[j] = tau;
    const double x = along_x[j], y = along_y[j];
    return {s.xx + tau * x * x, s.yy + tau * y * y, s.zz, s.xy + tau * x * y};
  }
  /// What the zero-energy control acts on at particle i of the tile.
  [[gnu::always_inline]] Gradient controlled(const TileStep& t, std::int32_t i, std::int32_t j,
                                             const TileStep::Deformed& f) const {
    const Gradient c = t.controlled(i, f, elastic[j]);
    return own(j, c.xx, c.xy, c.yx, c.yy);
  }

  double* interface_stress;
  const double *along_x, *along_y, *elastic;
  const double *a[16], *tie[4];
};

/// As material_step where another soil is near. `place` of the first particle in the own sides.
template <SoilLaw Law, bool watched>
LargestChange interface_step(const ConsistentArrays& c, const TileStep& tile, std::int32_t first,
                             std::int32_t last, const LawView& view, std::int32_t place) {
  const TileStep t = tile;
  const OwnSideStep side(c, t.particle + first, place);
  const Law law = *static_cast<const Law*>(view.law);
  double* history[history_size<Law> + 1];
  for (std::size_t k = 0; k < history_size<Law>; ++k) history[k] = view.history[k] + t.particle;
  double strain = 0, speed_squared = 0;
#pragma omp simd reduction(max : strain, speed_squared)
  for (std::int32_t j = 0; j < last - first; ++j) {
    const std::int32_t i = first + j;
    const Gradient gradient = side.gradient(j, t.gradient(i));
    typename Law::History q = load_history<Law>(history, i);
    const Stress old = t.old_stress(i), s = law.step(old, gradient, t.dt, q);
    const double yields = watched ? departs(s, law.elastic_step(old, gradient, t.dt)) : 0;
    if (watched) t.yields[i] = yields;
    store_history<Law>(history, i, q);
    t.store_stress(i, s);
    const TileStep::Deformed f = t.deform(i, strain, speed_squared);
    t.write_flux(i, side.tied(j, s, gradient, t.dt, yields), f, law.constrained_modulus(s, q),
                 gradient.trace(), side.controlled(t, i, j, f));
  }
  return {strain, speed_squared};
}

/// Either of them for a law that is called for all particles at once; `place` < 0: no other soil is near.
LargestChange external_step(const ConsistentArrays& c, const TileStep& tile, std::int32_t first,
                            std::int32_t last, const LawView& view, double elastic, std::int32_t place) {
  const TileStep t = tile;
  const OwnSideStep side(c, place < 0 ? 0 : t.particle + first, place < 0 ? 0 : place);
  const auto& law = *static_cast<const ExternalLaw*>(view.law);
  Row gradient[4];
  std::array<Stress, PairStencils::tile> elastic_stress;
  for (std::int32_t i = first; i < last; ++i) {
    const Gradient summed = t.gradient(i), g = place < 0 ? summed : side.gradient(i - first, summed);
    elastic_stress[i - first] = law.elastic().elastic_step(t.old_stress(i), g, t.dt);
    gradient[xx].value[i] = g.xx, gradient[xy].value[i] = g.xy;
    gradient[yx].value[i] = g.yx, gradient[yy].value[i] = g.yy;
  }
  double* history[LawView::most_history];
  for (std::size_t k = 0; k < view.history_count; ++k) history[k] = view.history[k] + t.particle + first;
  SoilTile soil{.count = last - first,
                .dt = t.dt,
                .gradient = {},
                .stress = t.stress + 4 * first,
                .history = {history, view.history_count}};
  for (int k = 0; k < 4; ++k) soil.gradient[k] = gradient[k].value + first;
  law.step(soil);
  const double modulus = law.elastic().constrained_modulus();
  double strain = 0, speed_squared = 0;
  for (std::int32_t i = first; i < last; ++i) {
    const Gradient g(gradient[xx].value[i], gradient[xy].value[i], gradient[yx].value[i],
                     gradient[yy].value[i]);
    const TileStep::Deformed f = t.deform(i, strain, speed_squared);
    const std::int32_t j = i - first;
    const double yields = departs(t.old_stress(i), elastic_stress[j]);
    if (t.yields) t.yields[i] = yields;
    if (place < 0)
      t.write_flux(i, t.old_stress(i), f, modulus, g.trace(), t.controlled(i, f, elastic));
    else
      t.write_flux(i, side.tied(j, t.old_stress(i), g, t.dt, yields), f, modulus, g.trace(),
                   side.controlled(t, i, j, f));
  }
  return {strain, speed_squared};
}

template <SoilLaw Law, bool watched>
LargestChange step_of(const ConsistentArrays& c, const TileStep& tile, std::int32_t first, std::int32_t last,
                      const LawView& law, double elastic, std::int32_t place) {
  return place < 0 ? material_step<Law, watched>(tile, first, last, law, elastic)
                   : interface_step<Law, watched>(c, tile, first, last, law, place);
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
                      change = step.yields && law.may_yield
                                   ? step_of<Law, true>(c, step, first, last, law, elastic, place)
                                   : step_of<Law, false>(c, step, first, last, law, elastic, place);
                    });
                  largest.strain = std::max(largest.strain, change.strain);
                  largest.speed_squared = std::max(largest.speed_squared, change.speed_squared);
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
template <bool wet>
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
    Vector fx = load(qxx) * own.x, fx2 = load(qxy) * own.y, fx3 = -own_w * load(vx);
    Vector fy = load(qyx) * own.x, fy2 = load(qyy) * own.y, fy3 = -own_w * load(vy);
    Vector px{}, py{};
    if (wet) px = -own.x * load(pw), py = -own.y * load(pw);
    for (std::int32_t k = stretch.pairs + 1; k < stretch.pairs_end; ++k) {
      const std::int32_t b = offset[k];
      const double gx = g[k].x, gy = g[k].y, w = viscous * g[k].w;
      fx += gx * load(qxx + b), fx2 += gy * load(qxy + b), fx3 += w * load(vx + b);
      fy += gx * load(qyx + b), fy2 += gy * load(qyy + b), fy3 += w * load(vy + b);
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
template <class Real>
inline void own_sums(const ConsistentArrays& c, const PairGeometryIn<Real>* g, std::int32_t a,
                     std::int32_t first, Row* out) {
  const PairStencils& s = *c.reference.stencils;
  const Record* records = c.fluxes.records;
  const std::int32_t* index = s.index.data();
  std::int64_t k = s.begin[a];
  const std::int64_t last = s.begin[a + 1];
  const PairGeometry sum = sum_of(g, k, last);
  Lanes x{}, y{}, w{}, x2{}, y2{}, w2{};
  for (++k; k + 1 < last; k += 2) {
    const Lanes q = records[index[k]].q, q2 = records[index[k + 1]].q;
    x += q * double{g[k].x}, x2 += q2 * double{g[k + 1].x};
    y += q * double{g[k].y}, y2 += q2 * double{g[k + 1].y};
    w += q * double{g[k].w}, w2 += q2 * double{g[k + 1].w};
  }
  if (k < last) {
    const Lanes q = records[index[k]].q;
    x += q * double{g[k].x}, y += q * double{g[k].y}, w += q * double{g[k].w};
  }
  x += x2, y += y2, w += w2;
  const Lanes own = records[a].q;
  const double viscous = 2 * c.control.viscosity;
  constexpr int v = velocity_lane, p = pressure_lane;
  *out[force_x].of(a, first) =
      x[xx] + y[xy] + own[xx] * sum.x + own[xy] * sum.y + viscous * (w[v] - own[v] * sum.w);
  *out[force_y].of(a, first) =
      x[yx] + y[yy] + own[yx] * sum.x + own[yy] * sum.y + viscous * (w[v + 1] - own[v + 1] * sum.w);
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

template <bool wet>
void accelerate_tile(const ConsistentArrays& c, std::int32_t number, double* out) {
  const TileRange tile = range_of(*c.reference.stencils, number);
  Row sum[4];
  const bool single = !c.reference.stencils->own_single.empty();
  for (const PairStencils::Piece* piece = tile.piece; piece != tile.piece_end; ++piece) {
    if (piece->stretch != PairStencils::own_list)
      shared_sums<wet>(c, *piece, tile.first, sum);
    else if (single)
      for (std::int32_t a = piece->first; a < piece->last; ++a)
        own_sums(c, c.reference.stencils->own_single.data(), a, tile.first, sum);
    else
      for (std::int32_t a = piece->first; a < piece->last; ++a)
        own_sums(c, c.reference.stencils->own.data(), a, tile.first, sum);
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
  c.motion.pressure ? accelerate_tile<true>(c, tile, out) : accelerate_tile<false>(c, tile, out);
}

}  // namespace

extern const ConsistentKernels consistent_kernels;
const ConsistentKernels consistent_kernels = {rates, strain, accelerate};

}  // namespace porosph::POROSPH_VECTOR_UNITS
