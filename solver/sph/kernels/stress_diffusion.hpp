// Diffusion of stress that alternates from particle to particle. For the kernels only, which are compiled for
// each kind of vector units.
#pragma once

#include "solver/sph/kernels/tile.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// A particle's stress as one vector; that of a solid fills six of eight.
template <class Space>
struct StressLanes {
  using Type = double __attribute__((vector_size(32)));
};
template <>
struct StressLanes<Solid> {
  using Type = double __attribute__((vector_size(64)));
};

template <class Space>
inline typename StressLanes<Space>::Type stress_at(const double* stresses, std::int64_t place) {
  typename StressLanes<Space>::Type s{};
  __builtin_memcpy(&s, stresses + stress_size<Space> * place, stress_size<Space> * sizeof(double));
  return s;
}

/// Calls use(b, geometry) for the neighbours with which particle a shares stress; `pairs`: of own lists, or
/// null where it shares a stencil.
template <class Space, class Pair, class Use>
inline void for_partners(const ConsistentArraysIn<Space>& c, const Pair* pairs, std::int32_t a, Use&& use) {
  const std::int32_t* soil = c.diffusion.soil;
  const std::int32_t mine = soil[a];
  const auto& s = *c.reference.stencils;
  if (pairs == nullptr) {
    s.for_neighbours(a, [&](std::int32_t b, const auto& g) {
      if (soil[b] == mine) use(b, g);
    });
    return;
  }
  const std::int32_t* index = s.index.data();
  for (std::int64_t k = s.begin[a] + 1, last = s.begin[a + 1]; k < last; ++k)
    if (soil[index[k]] == mine) use(index[k], pairs[k]);
}

/// Calls use(pairs, a) for the tile's particles.
template <class Space, class Use>
inline void for_each_with_pairs(const PairStencilsIn<Space>& s, const TileRange& tile, Use&& use) {
  using Pair = typename PairStencilsIn<Space>::Geometry;
  for_each_piece(
      s, tile,
      [&](const auto& piece) {
        for (std::int32_t a = piece.first; a < piece.last; ++a) use(static_cast<const Pair*>(nullptr), a);
      },
      use);
}

/// Marks the particles that are near to soil that shears: it diffuses there, or at a partner.
template <class Space, class Pair>
inline bool is_near(const ConsistentArraysIn<Space>& c, const Pair* pairs, std::int32_t a) {
  const double* diffusivity = c.diffusion.diffusivity;
  if (c.diffusion.soil[a] < 0) return false;
  double largest = diffusivity[a];
  if (largest == 0)
    for_partners(c, pairs, a,
                 [&](std::int32_t b, const auto&) { largest = std::max(largest, diffusivity[b]); });
  return largest > 0;
}

/// The gradient of the stress there, seen by the soil alone.
template <class Space>
void stress_gradients(const ConsistentArraysIn<Space>& c, const TileRange& tile) {
  constexpr int dim = Space::dim, size = stress_size<Space>;
  using Lanes = typename StressLanes<Space>::Type;
  const double* stress = c.diffusion.stress;
  for_each_with_pairs(*c.reference.stencils, tile, [&](const auto* pairs, std::int32_t a) {
    const bool near = is_near(c, pairs, a);
    c.diffusion.near[a] = near;
    if (!near) return;
    const Lanes own = stress_at<Space>(stress, a);
    Lanes sum[dim]{};
    for_partners(c, pairs, a, [&](std::int32_t b, const auto& g) {
      const Lanes difference = stress_at<Space>(stress, b) - own;
      for (int d = 0; d < dim; ++d) sum[d] += difference * double{along(g, d)};
    });
    const double* l = c.diffusion.correction + dim * dim * static_cast<std::int64_t>(a);
    double* out = c.diffusion.gradient + size * dim * static_cast<std::int64_t>(a);
    for (int d = 0; d < dim; ++d) {
      Lanes gradient{};
      for (int e = 0; e < dim; ++e) gradient += sum[e] * l[dim * e + d];
      __builtin_memcpy(out + size * d, &gradient, size * sizeof(double));
    }
  });
}

/// sum_b (D_a + D_b) dt V_b F_ab (s_b - s_a - (grad s_a + grad s_b) / 2 (x_b - x_a)).
template <class Space>
void diffuse(const ConsistentArraysIn<Space>& c, const TileRange& tile) {
  constexpr int dim = Space::dim, size = stress_size<Space>;
  using Lanes = typename StressLanes<Space>::Type;
  const double *stress = c.diffusion.stress, *gradients = c.diffusion.gradient;
  const double *diffusivity = c.diffusion.diffusivity, most = 2 * c.diffusion.most;
  for_each_with_pairs(*c.reference.stencils, tile, [&](const auto* pairs, std::int32_t a) {
    if (!c.diffusion.near[a]) return;
    const Lanes own = stress_at<Space>(stress, a);
    Lanes gradient[dim], change{};
    for (int d = 0; d < dim; ++d)
      gradient[d] = stress_at<Space>(gradients, dim * static_cast<std::int64_t>(a) + d);
    for_partners(c, pairs, a, [&](std::int32_t b, const auto& g) {
      Lanes wiggle = (stress_at<Space>(stress, b) - own) * double{g.w};
      for (int d = 0; d < dim; ++d) {
        const Lanes other = stress_at<Space>(gradients, dim * static_cast<std::int64_t>(b) + d);
        wiggle -= (gradient[d] + other) * (0.5 * double{along(g, d)});
      }
      const double both = diffusivity[a] + diffusivity[b];
      change += wiggle * (both < most ? both : most);
    });
    __builtin_memcpy(c.diffusion.change + size * static_cast<std::int64_t>(a), &change,
                     size * sizeof(double));
  });
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
