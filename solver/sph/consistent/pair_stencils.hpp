// The kernel gradients of a reference configuration, in the order in which sums over neighbours read them.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solver/space/tensor.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {

/// What a pair's sums need: G = V_b grad_a W_ab = w (x_b - x_a).
template <class Real, int dim = 2>
struct PairGeometryIn {
  Real x, y;  ///< G [1/m]
  Real w;     ///< [1/m2]
};
template <class Real>
struct PairGeometryIn<Real, 3> {
  Real x, y, z, w;
};
using PairGeometry = PairGeometryIn<double>;
using SinglePairGeometry = PairGeometryIn<float>;

inline PairGeometryIn<double> widened(const PairGeometryIn<float>& g) { return {g.x, g.y, g.w}; }
inline PairGeometryIn<double, 3> widened(const PairGeometryIn<float, 3>& g) { return {g.x, g.y, g.z, g.w}; }

/// Stencils of the first particles of a set of points. In a lattice a particle's neighbourhood is that of the
/// particle before it, shifted by one. Stretches of such particles share one stencil, and their sums run over
/// consecutive memory; all others have a list of their own.
///
/// The first entry of each stencil is the particle itself, with the sums over its neighbours.
template <class Space>
struct PairStencilsIn {
  using Geometry = PairGeometryIn<double, Space::dim>;
  using SingleGeometry = PairGeometryIn<float, Space::dim>;

  static constexpr std::int32_t tile = 128;    ///< particles that are summed at once
  static constexpr std::int32_t shortest = 8;  ///< stretch that is worth sharing
  static constexpr std::int32_t own_list = -1;

  struct Stretch {
    std::int32_t first, last;  ///< particles first to last - 1
    std::int32_t pairs, pairs_end;
  };
  std::vector<Stretch> stretches;
  std::vector<std::int32_t> offset;      ///< of stretches: the neighbour's number minus the particle's
  std::vector<Geometry> shared;          ///< beside offset
  std::vector<std::int32_t> stretch_of;  ///< of each particle, or own_list

  std::vector<std::int64_t> begin;         ///< of each particle's own list; nothing where it shares one
  std::vector<std::int32_t> index;         ///< of own lists: the neighbour's number
  std::vector<Geometry> own;               ///< beside index
  std::vector<SingleGeometry> own_single;  ///< in its place, half the size; sums only to rounding

  /// Particles of one tile that are summed alike.
  struct Piece {
    std::int32_t first, last;
    std::int32_t stretch;
  };
  std::vector<Piece> pieces;
  std::vector<std::int32_t> first_piece;  ///< of each tile, and one past the last

  std::int32_t particles() const { return static_cast<std::int32_t>(stretch_of.size()); }
  std::int32_t tiles() const { return static_cast<std::int32_t>(first_piece.size()) - 1; }

  /// Calls use(b, geometry) for each neighbour b of particle a, in increasing order.
  template <class Use>
  void for_neighbours(std::int32_t a, Use&& use) const {
    if (const std::int32_t s = stretch_of[a]; s != own_list) {
      for (std::int32_t k = stretches[s].pairs + 1; k < stretches[s].pairs_end; ++k)
        use(a + offset[k], shared[k]);
    } else {
      for (std::int64_t k = begin[a] + 1; k < begin[a + 1]; ++k)
        use(index[k], own_single.empty() ? own[k] : widened(own_single[k]));
    }
  }
  std::int32_t count_of_neighbours(std::int32_t a) const {
    if (const std::int32_t s = stretch_of[a]; s != own_list)
      return stretches[s].pairs_end - stretches[s].pairs - 1;
    return static_cast<std::int32_t>(begin[a + 1] - begin[a]) - 1;
  }
  std::int32_t last_neighbour(std::int32_t a) const {  ///< or a itself, if it has none
    if (const std::int32_t s = stretch_of[a]; s != own_list) return a + offset[stretches[s].pairs_end - 1];
    return index[begin[a + 1] - 1];
  }
  bool are_neighbours(std::int32_t a, std::int32_t b) const;
  /// The numbers of particle a's neighbours, in increasing order; `room`: for those of a shared stencil.
  std::span<const std::int32_t> neighbours(std::int32_t a, std::vector<std::int32_t>& room) const;
};

using PairStencils = PairStencilsIn<Plane>;

/// How far away neighbours may be [m]. With h = dx they lie at the rim of the support, where the kernel's
/// slope is zero. Left out, so that round-off does not give some particles more of them than others, which
/// would share no stencil.
template <int dim>
double stencil_reach(const CubicSpline<dim>& kernel) {
  return (1 - 1e-9) * kernel.support();
}

/// Those within reach of the first `count` points.
template <class Vector, int dim>
NeighbourList stencil_neighbours(const std::vector<Vector>& points, std::size_t count,
                                 const CubicSpline<dim>& kernel) {
  return find_neighbours(points, count, stencil_reach(kernel));
}

/// The stencils of the first points, one for each list of neighbours; `volumes` of all points [m2, m3 in a
/// solid]. `single`: own lists are stored in single precision.
template <class Space>
PairStencilsIn<Space> make_pair_stencils_in(std::span<const VectorIn<Space>> points, NeighbourList neighbours,
                                            std::span<const double> volumes,
                                            const CubicSpline<Space::dim>& kernel, bool single = false);

inline PairStencils make_pair_stencils(std::span<const Vec2> points, NeighbourList neighbours,
                                       std::span<const double> volumes, const CubicSpline<2>& kernel,
                                       bool single = false) {
  return make_pair_stencils_in<Plane>(points, std::move(neighbours), volumes, kernel, single);
}

}  // namespace porosph
