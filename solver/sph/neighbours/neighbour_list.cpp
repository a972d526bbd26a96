#include "solver/sph/neighbours/neighbour_list.hpp"

#include <algorithm>
#include <array>

#include "solver/sph/neighbours/cell_grid.hpp"

namespace porosph {
namespace {

/// Sorts numbers that differ, by how many are smaller than each one, which is vector code. With it a column
/// that collapses takes 2 to 3 % less time in all than with std::sort.
void sort_distinct(std::span<std::int32_t> numbers) {
  constexpr std::size_t few = 64;
  const std::size_t count = numbers.size();
  if (count > few) {
    std::ranges::sort(numbers);
    return;
  }
  std::array<std::int32_t, few> sorted;
  for (const std::int32_t number : numbers) {
    std::int32_t smaller = 0;
    for (std::size_t k = 0; k < count; ++k) smaller += numbers[k] < number ? 1 : 0;
    sorted[smaller] = number;
  }
  std::copy_n(sorted.begin(), count, numbers.begin());
}

template <class Vector>
NeighbourList search(std::span<const Vector> centres, std::span<const Vector> points, double radius,
                     bool skip_self) {
  const CellGrid<Vector::RowsAtCompileTime> grid(points, radius);
  return collected(centres.size(), [&](std::size_t a, std::vector<std::int32_t>& list) {
    const auto begin = std::ssize(list);
    const std::int32_t self = skip_self ? static_cast<std::int32_t>(a) : -1;
    auto end = list.size();
    grid.around(centres[a], [&](std::span<const std::int32_t> numbers, const Vector* places) {
      list.resize(end + numbers.size());
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        list[end] = numbers[k];
        end += ((places[k] - centres[a]).squaredNorm() < radius * radius) & (numbers[k] != self);
      }
    });
    list.resize(end);
    sort_distinct(std::span(list).subspan(begin));
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
