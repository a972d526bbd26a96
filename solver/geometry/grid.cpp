#include "solver/geometry/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace porosph {
namespace {

int floor_to_int(double x) { return static_cast<int>(std::floor(x)); }

/// The part of a's and b's segment with y between low and high, as a range of x; a below b.
std::pair<double, double> range_of_x(const Point& a, const Point& b, double low, double high) {
  const auto x_at = [&](double y) {
    const double t = b.y() > a.y() ? std::clamp((y - a.y()) / (b.y() - a.y()), 0.0, 1.0) : 0.0;
    return a.x() + t * (b.x() - a.x());
  };
  if (low <= a.y() && b.y() <= high) return std::minmax({a.x(), b.x()});
  return std::minmax({x_at(low), x_at(high)});
}

void mark_edge(const Grid& grid, Point a, Point b, double margin, std::vector<CellPlace>& places) {
  if (a.y() > b.y()) std::swap(a, b);
  const auto row_of = [&](double y) {
    return std::clamp(floor_to_int((y - grid.origin.y()) / grid.spacing), 0, grid.rows - 1);
  };
  const auto column_of = [&](double x) {
    return std::clamp(floor_to_int((x - grid.origin.x()) / grid.spacing), 0, grid.columns - 1);
  };
  for (int row = row_of(a.y() - margin); row <= row_of(b.y() + margin); ++row) {
    const double bottom = grid.origin.y() + row * grid.spacing;
    const auto [left, right] = range_of_x(a, b, bottom - margin, bottom + grid.spacing + margin);
    std::fill(places.begin() + grid.cell(column_of(left - margin), row),
              places.begin() + grid.cell(column_of(right + margin), row) + 1, CellPlace::at_outline);
  }
}

}  // namespace

Grid cover(const std::vector<Region>& regions, double spacing) {
  Point low = regions.front().lower_left(), high = regions.front().upper_right();
  for (const Region& region : regions) {
    low = low.cwiseMin(region.lower_left());
    high = high.cwiseMax(region.upper_right());
  }
  const Eigen::Array2d counts = ((high - low).array() / spacing - 1e-9).ceil().max(1);
  if (!(counts.prod() < std::numeric_limits<int>::max()))
    throw std::runtime_error(
        "particles.spacing is too small for the size of the soils: more than 2^31 particles");
  return {low, spacing, static_cast<int>(counts.x()), static_cast<int>(counts.y())};
}

std::vector<CellPlace> place_cells(const Grid& grid, const Region& region, double margin) {
  std::vector<CellPlace> places(grid.cells(), CellPlace::outside);
  for (const Polygon& ring : region.rings())
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      mark_edge(grid, ring[j], ring[i], margin, places);

  // Between two cells at the outline all cells of a row lie on the same side.
  for (int cell = 0; cell < grid.cells(); ++cell) {
    if (places[cell] == CellPlace::at_outline) continue;
    const bool as_before = grid.column(cell) > 0 && places[cell - 1] != CellPlace::at_outline;
    if (as_before)
      places[cell] = places[cell - 1];
    else if (region.contains(grid.centre(cell)))
      places[cell] = CellPlace::inside;
  }
  return places;
}

}  // namespace porosph
