#include "solver/sph/neighbours/neighbour_list.hpp"

#include <algorithm>

#include "solver/sph/neighbours/cell_grid.hpp"

namespace porosph {
namespace {

template <class Vector>
NeighbourList search(std::span<const Vector> centres, std::span<const Vector> points, double radius,
                     bool skip_self) {
  const CellGrid<Vector::RowsAtCompileTime> grid(points, radius);
  return collected(centres.size(), [&](std::size_t a, std::vector<std::int32_t>& list) {
    const auto begin = std::ssize(list);
    const std::int32_t self = skip_self ? static_cast<std::int32_t>(a) : -1;
    grid.around(centres[a], [&](std::int32_t b, const Vector& place) {
      if ((place - centres[a]).squaredNorm() < radius * radius && b != self) list.push_back(b);
    });
    std::sort(list.begin() + begin, list.end());
  });
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
