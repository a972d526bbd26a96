#include "solver/sph/neighbours/neighbour_list.hpp"

#include <algorithm>

#include "solver/sph/neighbours/cell_grid.hpp"

namespace porosph {
namespace {

/// Two passes, count then fill, so that particles are searched in parallel and the result does not depend on
/// threads.
template <class Vector>
NeighbourList search(std::span<const Vector> centres, std::span<const Vector> points, double radius,
                     bool skip_self) {
  const CellGrid<Vector::RowsAtCompileTime> grid(points, radius);
  const auto count = static_cast<std::int64_t>(centres.size());
  const auto visit = [&](std::int64_t a, auto&& use) {
    grid.around(centres[a], [&](std::int32_t b) {
      if ((points[b] - centres[a]).squaredNorm() < radius * radius && !(skip_self && b == a)) use(b);
    });
  };

  NeighbourList list;
  list.begin.assign(centres.size() + 1, 0);
#pragma omp parallel for schedule(static)
  for (std::int64_t a = 0; a < count; ++a) visit(a, [&](std::int32_t) { ++list.begin[a + 1]; });
  for (std::int64_t a = 0; a < count; ++a) list.begin[a + 1] += list.begin[a];
  list.index.resize(static_cast<std::size_t>(list.begin.back()));
#pragma omp parallel for schedule(static)
  for (std::int64_t a = 0; a < count; ++a) {
    auto end = list.index.begin() + list.begin[a];
    visit(a, [&](std::int32_t b) { *end++ = b; });
    std::sort(list.index.begin() + list.begin[a], end);
  }
  return list;
}

}  // namespace

NeighbourList find_neighbours(std::span<const Vec2> points, std::size_t count, double radius) {
  return search(points.first(count), points, radius, true);
}

NeighbourList find_neighbours(std::span<const Vec3> points, std::size_t count, double radius) {
  return search(points.first(count), points, radius, true);
}

NeighbourList find_neighbours(std::span<const Vec2> centres, std::span<const Vec2> points, double radius) {
  return search(centres, points, radius, false);
}

}  // namespace porosph
