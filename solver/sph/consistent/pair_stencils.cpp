#include "solver/sph/consistent/pair_stencils.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/sph/kernels/pair_weights.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {
namespace {

template <class Real>
PairGeometryIn<Real> packed(const Vec2& g, double w) {
  return {static_cast<Real>(g.x()), static_cast<Real>(g.y()), static_cast<Real>(w)};
}
template <class Real>
PairGeometryIn<Real, 3> packed(const Vec3& g, double w) {
  return {static_cast<Real>(g.x()), static_cast<Real>(g.y()), static_cast<Real>(g.z()), static_cast<Real>(w)};
}

template <class Real>
PairGeometryIn<Real> narrowed(const PairGeometryIn<double>& g) {
  return packed<Real>(Vec2(g.x, g.y), g.w);
}
template <class Real>
PairGeometryIn<Real, 3> narrowed(const PairGeometryIn<double, 3>& g) {
  return packed<Real>(Vec3(g.x, g.y, g.z), g.w);
}

/// Adds what is stored of a pair, rounded as it is there.
template <class Real>
void add(const PairGeometryIn<Real>& g, PairGeometryIn<double>& sum) {
  sum.x += g.x, sum.y += g.y, sum.w += g.w;
}
template <class Real>
void add(const PairGeometryIn<Real, 3>& g, PairGeometryIn<double, 3>& sum) {
  sum.x += g.x, sum.y += g.y, sum.z += g.z, sum.w += g.w;
}

template <class Space>
class Builder {
  using PairStencils = PairStencilsIn<Space>;
  using Vector = VectorIn<Space>;
  using Geometry = typename PairStencils::Geometry;

 public:
  Builder(std::span<const Vector> points, NeighbourList list, std::span<const double> volumes,
          const CubicSpline<Space::dim>& kernel, bool single)
      : points_(points),
        volumes_(volumes),
        weighed_{points.data()->data(), volumes.data(), kernel},
        single_(single),
        count_(static_cast<std::int32_t>(list.begin.size()) - 1),
        list_(std::move(list)) {
    double largest = 0;
    for (const Vector& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    rounding_ = 16 * std::numeric_limits<double>::epsilon() * largest;
  }

  PairStencils build() {
    find_stretches();
    fill_shared();
    fill_own();
    cut_into_tiles();
    return std::move(stencils_);
  }

 private:
  /// The neighbourhood of b is that of a, shifted: same distances, to rounding, and same volumes.
  bool repeats(std::int32_t a, std::int32_t b) const {
    const auto of_a = list_.of(a), of_b = list_.of(b);
    if (of_a.size() != of_b.size()) return false;
    for (std::size_t k = 0; k < of_a.size(); ++k) {
      const std::int32_t c = of_a[k], d = of_b[k];
      if (d - b != c - a) return false;
      const Vector difference = (points_[d] - points_[b]) - (points_[c] - points_[a]);
      if (!(difference.cwiseAbs().maxCoeff() <= rounding_)) return false;
      if (!(std::abs(volumes_[d] - volumes_[c]) <= 1e-13 * volumes_[c])) return false;
    }
    return true;
  }

  void find_stretches() {
    stencils_.stretch_of.assign(count_, PairStencils::own_list);
    for (std::int32_t first = 0, last = 0; first < count_; first = last) {
      last = first + 1;
      while (last < count_ && repeats(first, last)) ++last;
      if (last - first < PairStencils::shortest) continue;
      const auto stretch = static_cast<std::int32_t>(stencils_.stretches.size());
      std::fill(stencils_.stretch_of.begin() + first, stencils_.stretch_of.begin() + last, stretch);
      stencils_.stretches.push_back({first, last, 0, 0});
    }
  }

  /// Writes the particle itself, then its neighbours; `number` is what stands for neighbour b.
  template <class Real, class Number>
  void write(std::int32_t a, std::int32_t* index, PairGeometryIn<Real, Space::dim>* geometry,
             Number&& number) const {
    const auto neighbours = list_.of(a);
    const std::span<const double> weights = weights_of(a, neighbours, weighed_);
    Geometry sum{};
    for (std::size_t i = 0, k = 1; i < neighbours.size(); ++i, ++k) {
      const std::int32_t b = neighbours[i];
      index[k] = number(b);
      geometry[k] = packed<Real>(Vector(weights[i] * (points_[b] - points_[a])), weights[i]);
      add(geometry[k], sum);
    }
    index[0] = number(a);
    geometry[0] = narrowed<Real>(sum);
  }

  void fill_shared() {
    for (typename PairStencils::Stretch& s : stencils_.stretches) {
      s.pairs = static_cast<std::int32_t>(stencils_.offset.size());
      const std::size_t size = stencils_.offset.size() + 1 + list_.of(s.first).size();
      stencils_.offset.resize(size);
      stencils_.shared.resize(size);
      s.pairs_end = static_cast<std::int32_t>(size);
      write(s.first, stencils_.offset.data() + s.pairs, stencils_.shared.data() + s.pairs,
            [&](std::int32_t b) { return b - s.first; });
    }
  }

  void fill_own() {
    stencils_.begin.assign(static_cast<std::size_t>(count_) + 1, 0);
    for (std::int32_t a = 0; a < count_; ++a) {
      const bool own = stencils_.stretch_of[a] == PairStencils::own_list;
      stencils_.begin[a + 1] = stencils_.begin[a] + (own ? 1 + std::ssize(list_.of(a)) : 0);
    }
    stencils_.index.resize(static_cast<std::size_t>(stencils_.begin.back()));
    if (single_)
      write_own(stencils_.own_single);
    else
      write_own(stencils_.own);
  }

  template <class Real>
  void write_own(std::vector<PairGeometryIn<Real, Space::dim>>& own) {
    own.resize(stencils_.index.size());
#pragma omp parallel for schedule(static)
    for (std::int32_t a = 0; a < count_; ++a) {
      if (stencils_.stretch_of[a] != PairStencils::own_list) continue;
      const std::int64_t first = stencils_.begin[a];
      write(a, stencils_.index.data() + first, own.data() + first, [](std::int32_t b) { return b; });
    }
  }

  void cut_into_tiles() {
    stencils_.first_piece = {0};
    for (std::int32_t tile = 0; tile < count_; tile += PairStencils::tile) {
      const std::int32_t end = std::min(tile + PairStencils::tile, count_);
      for (std::int32_t a = tile; a < end;) {
        const std::int32_t stretch = stencils_.stretch_of[a], first = a;
        while (a < end && stencils_.stretch_of[a] == stretch) ++a;
        stencils_.pieces.push_back({first, a, stretch});
      }
      stencils_.first_piece.push_back(static_cast<std::int32_t>(stencils_.pieces.size()));
    }
  }

  std::span<const Vector> points_;
  std::span<const double> volumes_;
  WeighedPoints<Space::dim> weighed_;
  bool single_;
  std::int32_t count_;
  NeighbourList list_;
  double rounding_ = 0;  ///< of a difference of coordinates [m]
  PairStencils stencils_;
};

}  // namespace

template <class Space>
bool PairStencilsIn<Space>::are_neighbours(std::int32_t a, std::int32_t b) const {
  if (const std::int32_t s = stretch_of[a]; s != own_list)
    return std::binary_search(offset.begin() + stretches[s].pairs + 1,
                              offset.begin() + stretches[s].pairs_end, b - a);
  return std::binary_search(index.begin() + begin[a] + 1, index.begin() + begin[a + 1], b);
}

template <class Space>
std::span<const std::int32_t> PairStencilsIn<Space>::neighbours(std::int32_t a,
                                                                std::vector<std::int32_t>& room) const {
  if (stretch_of[a] == own_list) return {index.data() + begin[a] + 1, index.data() + begin[a + 1]};
  const Stretch& stretch = stretches[stretch_of[a]];
  room.assign(offset.begin() + stretch.pairs + 1, offset.begin() + stretch.pairs_end);
  for (std::int32_t& b : room) b += a;
  return room;
}

template <class Space>
PairStencilsIn<Space> make_pair_stencils_in(std::span<const VectorIn<Space>> points, NeighbourList neighbours,
                                            std::span<const double> volumes,
                                            const CubicSpline<Space::dim>& kernel, bool single) {
  return Builder<Space>(points, std::move(neighbours), volumes, kernel, single).build();
}

template struct PairStencilsIn<Plane>;
template struct PairStencilsIn<Axisymmetric>;
template struct PairStencilsIn<Solid>;
template PairStencilsIn<Plane> make_pair_stencils_in<Plane>(std::span<const Vec2>, NeighbourList,
                                                            std::span<const double>, const CubicSpline<2>&,
                                                            bool);
template PairStencilsIn<Axisymmetric> make_pair_stencils_in<Axisymmetric>(std::span<const Vec2>,
                                                                          NeighbourList,
                                                                          std::span<const double>,
                                                                          const CubicSpline<2>&, bool);
template PairStencilsIn<Solid> make_pair_stencils_in<Solid>(std::span<const Vec3>, NeighbourList,
                                                            std::span<const double>, const CubicSpline<3>&,
                                                            bool);

}  // namespace porosph
