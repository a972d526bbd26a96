// Accelerations of a tile of particles from the fluxes. For the kernels only, which are compiled for each
// kind of vector units.
#pragma once

#include "solver/sph/kernels/matrices.hpp"
#include "solver/sph/kernels/tile.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// mu of the particles from i on, where each has one of its own; times X in Axisymmetric.
template <class Space, bool varies>
inline Vector viscosities(const ConsistentArraysIn<Space>& c, std::int32_t i) {
  if constexpr (has_hoop<Space>) {
    const Vector radius = load(c.reference.radius + i);
    return varies ? radius * load(c.flow.viscosity + i) : radius * c.control.viscosity;
  } else {
    return load(c.flow.viscosity + i);
  }
}

/// sum_b (P_a L_a + P_b L_b) G_ab with the zero-energy term, and sum_b (p_b - p_a) G_ab, of a stretch.
/// `varies`: each particle has a viscosity of its own.
template <class Space, bool wet, bool varies, class Piece>
void shared_sums(const ConsistentArraysIn<Space>& c, const Piece& piece, std::int32_t first, Row* out) {
  constexpr int dim = Space::dim;
  constexpr bool uneven = varies || has_hoop<Space>;
  const auto& s = *c.reference.stencils;
  const auto stretch = s.stretches[piece.stretch];
  const std::int32_t* offset = s.offset.data();
  const auto* g = s.shared.data();
  const double viscous = 2 * c.control.viscosity;
  by_vectors(piece, stretch, [&](std::int32_t a) {
    const auto own = g[stretch.pairs];
    const double own_w = viscous * own.w;
    Vector force[dim][dim], control[dim], pressure[dim];
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) force[i][j] = load(c.fluxes.flux[dim * i + j] + a) * along(own, j);
      control[i] = uneven ? Vector{} : -own_w * load(c.motion.controlled[i] + a);
      if (wet) pressure[i] = -along(own, i) * load(c.motion.pressure + a);
    }
    for (std::int32_t k = stretch.pairs + 1; k < stretch.pairs_end; ++k) {
      const std::int32_t b = a + offset[k];
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) force[i][j] += along(g[k], j) * load(c.fluxes.flux[dim * i + j] + b);
      if constexpr (uneven) {
        const Vector both = g[k].w * (viscosities<Space, varies>(c, a) + viscosities<Space, varies>(c, b));
        for (int i = 0; i < dim; ++i)
          control[i] += both * (load(c.motion.controlled[i] + b) - load(c.motion.controlled[i] + a));
      } else {
        const double w = viscous * g[k].w;
        for (int i = 0; i < dim; ++i) control[i] += w * load(c.motion.controlled[i] + b);
      }
      if (wet) {
        const Vector p = load(c.motion.pressure + b);
        for (int i = 0; i < dim; ++i) pressure[i] += along(g[k], i) * p;
      }
    }
    for (int i = 0; i < dim; ++i) {
      Vector sum = force[i][0];
      for (int j = 1; j < dim; ++j) sum += force[i][j];
      store(out[i].of(a, first), sum + control[i]);
      if (wet) store(out[dim + i].of(a, first), pressure[i]);
    }
  });
}

/// A record's lines, summed over neighbours; and what is in its lanes.
template <class Space>
struct RecordSum {
  static constexpr int lines = RecordIn<Space>::lines;
  Lanes line[lines] = {};

  void add(const RecordIn<Space>& r, double times) {
    for (int l = 0; l < lines; ++l) line[l] += reinterpret_cast<const Lanes*>(r.q)[l] * times;
  }
  void add(const RecordSum& other) {
    for (int l = 0; l < lines; ++l) line[l] += other.line[l];
  }
  double operator[](int k) const { return line[k / 8][k % 8]; }
};

/// The same of a particle with a list of its own.
template <class Space, bool varies, class Pair>
inline void own_sums(const ConsistentArraysIn<Space>& c, const Pair* g, std::int32_t a, std::int32_t first,
                     Row* out) {
  constexpr int dim = Space::dim;
  constexpr bool uneven = varies || has_hoop<Space>;
  using Record = RecordIn<Space>;
  const auto& s = *c.reference.stencils;
  const Record* records = c.fluxes.records;
  const std::int32_t* index = s.index.data();
  std::int64_t k = s.begin[a];
  const std::int64_t last = s.begin[a + 1];
  const auto sum = sum_of(g, k, last);
  const double mu = uneven ? records[a].q[Record::viscosity] : 0;
  // The weight of a pair's velocities, for both of its viscosities where they vary.
  const auto weight = [&](std::int64_t at, const Record& other) {
    return uneven ? double{g[at].w} * (mu + other.q[Record::viscosity]) : double{g[at].w};
  };
  RecordSum<Space> by[dim], second[dim], w, w2;
  double weights = 0;
  for (++k; k + 1 < last; k += 2) {
    const Record &other = records[index[k]], &next = records[index[k + 1]];
    const double one = weight(k, other), two = weight(k + 1, next);
    for (int j = 0; j < dim; ++j) by[j].add(other, along(g[k], j)), second[j].add(next, along(g[k + 1], j));
    w.add(other, one), w2.add(next, two);
    if (uneven) weights += one + two;
  }
  if (k < last) {
    const Record& other = records[index[k]];
    const double one = weight(k, other);
    for (int j = 0; j < dim; ++j) by[j].add(other, along(g[k], j));
    w.add(other, one);
    if (uneven) weights += one;
  }
  for (int j = 0; j < dim; ++j) by[j].add(second[j]);
  w.add(w2);
  const double* own = records[a].q;
  const double viscous = uneven ? 1 : 2 * c.control.viscosity, sum_w = uneven ? weights : sum.w;
  constexpr int v = Record::velocity, p = Record::pressure;
  for (int i = 0; i < dim; ++i) {
    double force = by[0][dim * i];
    for (int j = 1; j < dim; ++j) force += by[j][dim * i + j];
    for (int j = 0; j < dim; ++j) force += own[dim * i + j] * along(sum, j);
    *out[i].of(a, first) = force + viscous * (w[v + i] - own[v + i] * sum_w);
    *out[dim + i].of(a, first) = by[i][p] - own[p] * along(sum, i);  // eq. (22)
  }
}

/// A vector in plain numbers.
template <int dim>
struct PlainVector;
template <>
struct PlainVector<2> {
  double x, y;
};
template <>
struct PlainVector<3> {
  double x, y, z;
};

template <int dim>
[[gnu::always_inline]] inline PlainVector<dim> vector_at(const double* const* numbers, std::int32_t i) {
  if constexpr (dim == 3)
    return {numbers[0][i], numbers[1][i], numbers[2][i]};
  else
    return {numbers[0][i], numbers[1][i]};
}

/// L q.
[[gnu::always_inline]] inline PlainVector<2> times(const Gradient& l, const PlainVector<2>& q) {
  return {l.xx * q.x + l.xy * q.y, l.yx * q.x + l.yy * q.y};
}
[[gnu::always_inline]] inline PlainVector<3> times(const GradientIn<Solid>& l, const PlainVector<3>& q) {
  return {l.xx * q.x + l.xy * q.y + l.xz * q.z, l.yx * q.x + l.yy * q.y + l.yz * q.z,
          l.zx * q.x + l.zy * q.y + l.zz * q.z};
}

/// Adds J F^-T q of particle i, q a gradient in the reference.
template <class Space>
[[gnu::always_inline]] inline void add_pushed_forward(double (&to)[3], const double* const* f, std::int32_t i,
                                                      PlainVector<Space::dim> q) {
  if constexpr (Space::dim == 3) {
    const PlainVector<3> p = times(cofactor(gradient_at<Solid>(f, i)), q);
    to[0] += p.x, to[1] += p.y, to[2] += p.z;
  } else {
    if constexpr (has_hoop<Space>) q.x *= f[4][i], q.y *= f[4][i];
    to[0] += f[3][i] * q.x - f[2][i] * q.y, to[1] += f[0][i] * q.y - f[1][i] * q.x;  // cofactors of F
  }
}

/// What closed gradients add: sum_b (P_a + P_b) w_ab (kappa_b - kappa_a) and, likewise, sum_b (p_b - p_a)
/// ..., of a stretch.
template <class Space, bool wet, class Piece>
void shared_closing_sums(const ConsistentArraysIn<Space>& c, const Piece& piece, std::int32_t first,
                         Row* out) {
  constexpr int dim = Space::dim;
  const auto& s = *c.reference.stencils;
  const auto stretch = s.stretches[piece.stretch];
  by_vectors(piece, stretch, [&](std::int32_t a) {
    Vector change[dim], all[dim]{}, force[dim]{}, pressure[dim]{};
    for (std::int32_t k = stretch.pairs + 1; k < stretch.pairs_end; ++k) {
      const std::int32_t b = a + s.offset[k];
      for (int j = 0; j < dim; ++j) {
        change[j] = s.shared[k].w * (load(c.reference.kappa[j] + b) - load(c.reference.kappa[j] + a));
        all[j] += change[j];
      }
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) force[i] += change[j] * load(c.fluxes.piola[dim * i + j] + b);
      if (wet) {
        const Vector p = load(c.motion.pressure + b) - load(c.motion.pressure + a);
        for (int j = 0; j < dim; ++j) pressure[j] += change[j] * p;
      }
    }
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) force[i] += all[j] * load(c.fluxes.piola[dim * i + j] + a);
      store(out[i].of(a, first), force[i]);
      if (wet) store(out[dim + i].of(a, first), pressure[i]);
    }
  });
}

/// The same of a particle with a list of its own.
template <class Space, bool wet, class Pair>
inline void own_closing_sums(const ConsistentArraysIn<Space>& c, const Pair* g, std::int32_t a,
                             std::int32_t first, Row* out) {
  constexpr int dim = Space::dim;
  const auto& s = *c.reference.stencils;
  struct Sums {
    double all[dim]{}, force[dim][dim]{}, pressure[dim]{};
  } sums[2];
  add_by_twos(s, a, sums, [&](std::int64_t k, Sums& to) {
    const std::int32_t b = s.index[k];
    const double p = wet ? c.motion.pressure[b] - c.motion.pressure[a] : 0;
    for (int j = 0; j < dim; ++j) {
      const double change = g[k].w * (c.reference.kappa[j][b] - c.reference.kappa[j][a]);
      to.all[j] += change, to.pressure[j] += change * p;
      for (int i = 0; i < dim; ++i) to.force[i][j] += change * c.fluxes.piola[dim * i + j][b];
    }
  });
  for (int i = 0; i < dim; ++i) {
    double force = 0;
    for (int j = 0; j < dim; ++j)
      force += sums[0].force[i][j] + sums[1].force[i][j] +
               (sums[0].all[j] + sums[1].all[j]) * c.fluxes.piola[dim * i + j][a];
    *out[i].of(a, first) = force;
    *out[dim + i].of(a, first) = sums[0].pressure[i] + sums[1].pressure[i];
  }
}

/// What turns the sums of a tile into accelerations, from the tile's first particle on.
template <class Space>
struct TileForces {
  static constexpr int dim = Space::dim;

  TileForces(const ConsistentArraysIn<Space>& c, const TileRange& tile, Row* rows, double* out)
      : density(c.reference.density + tile.first),
        fill(c.reference.fill + tile.first),
        radius(c.reference.radius + (has_hoop<Space> ? tile.first : 0)),
        hoop(c.fluxes.hoop + (has_hoop<Space> ? tile.first : 0)),
        result(out + dim * static_cast<std::int64_t>(tile.first)) {
    for (int d = 0; d < dim; ++d) {
      force[d] = rows[d].value, pressure[d] = rows[dim + d].value;
      gravity[d] = c.gravity[d];
    }
    for (int k = 0; k < gradient_size<Space>; ++k) deformation[k] = c.state.deformation[k] + tile.first;
    for (int k = 0; k < matrix_size<Space>; ++k) correction[k] = c.reference.correction[k] + tile.first;
  }

  /// In a function of its own: see particle_step.
  template <bool wet>
  [[gnu::always_inline]] void accelerate(std::int32_t i) const {
    const double per_fill = 1 / fill[i];
    double f[3] = {per_fill * force[0][i], per_fill * force[1][i], 0};
    if constexpr (dim == 3) f[2] = per_fill * force[2][i];
    if constexpr (has_hoop<Space>) {
      const double per_radius = 1 / radius[i];
      f[0] = (f[0] - hoop[i]) * per_radius, f[1] *= per_radius;
    }
    if (wet)
      add_pushed_forward<Space>(f, deformation, i,
                                times(matrix_at<Space>(correction, i), vector_at<dim>(pressure, i)));
    const double per_mass = 1 / density[i];
    for (int d = 0; d < dim; ++d) result[dim * i + d] = f[d] * per_mass + gravity[d];
  }
  /// Of the sums that closed gradients add.
  template <bool wet>
  [[gnu::always_inline]] void close(std::int32_t i) const {
    double f[3] = {force[0][i], force[1][i], 0};
    if constexpr (dim == 3) f[2] = force[2][i];
    if (wet) add_pushed_forward<Space>(f, deformation, i, vector_at<dim>(pressure, i));
    const double per_mass = 1 / density[i];
    for (int d = 0; d < dim; ++d) result[dim * i + d] += f[d] * per_mass;
  }

  const double *density, *fill, *radius, *hoop;
  double* result;
  double gravity[dim];
  const double *force[dim], *pressure[dim], *deformation[gradient_size<Space>],
      *correction[matrix_size<Space>];
};

template <class Space, bool wet>
void add_closing_accelerations(const ConsistentArraysIn<Space>& c, const TileRange& tile, double* out) {
  Row sum[2 * Space::dim];
  for_each_piece(
      *c.reference.stencils, tile,
      [&](const auto& piece) { shared_closing_sums<Space, wet>(c, piece, tile.first, sum); },
      [&](const auto* pairs, std::int32_t a) { own_closing_sums<Space, wet>(c, pairs, a, tile.first, sum); });
  const TileForces<Space> forces(c, tile, sum, out);
  const std::int32_t count = tile.last - tile.first;
#pragma omp simd
  for (std::int32_t i = 0; i < count; ++i) forces.template close<wet>(i);
}

template <class Space, bool wet, bool varies>
void accelerate_tile(const ConsistentArraysIn<Space>& c, const TileRange& tile, double* out) {
  Row sum[2 * Space::dim];
  for_each_piece(
      *c.reference.stencils, tile,
      [&](const auto& piece) { shared_sums<Space, wet, varies>(c, piece, tile.first, sum); },
      [&](const auto* pairs, std::int32_t a) { own_sums<Space, varies>(c, pairs, a, tile.first, sum); });
  const TileForces<Space> forces(c, tile, sum, out);
  const std::int32_t count = tile.last - tile.first;
#pragma omp simd
  for (std::int32_t i = 0; i < count; ++i) forces.template accelerate<wet>(i);
  if (c.reference.kappa[0]) add_closing_accelerations<Space, wet>(c, tile, out);
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
