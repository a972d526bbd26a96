#include "render/run/delaunay.hpp"

#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <stdexcept>

namespace porosph::render {
namespace {

struct GridPoint {
  int x, y;
};

/// Boost's diagram is exact for whole numbers.
std::vector<GridPoint> on_grid(const std::vector<Point>& points) {
  constexpr double cells = 1 << 28;
  Point low = Point::Constant(never), high = Point::Constant(-never);
  for (const Point& p : points) {
    if (!p.allFinite()) throw std::runtime_error("render: a particle's place is not finite");
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = points.empty() ? 1 : std::max((high - low).maxCoeff(), 1e-300);
  std::vector<GridPoint> grid;
  grid.reserve(points.size());
  for (const Point& p : points) {
    const Point scaled = (p - low) / size * cells;
    grid.push_back({static_cast<int>(std::lround(scaled.x())), static_cast<int>(std::lround(scaled.y()))});
  }
  return grid;
}

double doubled_area(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

std::vector<std::array<int, 3>> delaunay(const std::vector<Point>& points) {
  const std::vector<GridPoint> grid = on_grid(points);
  boost::polygon::voronoi_builder<int> builder;
  for (const GridPoint& p : grid) builder.insert_point(p.x, p.y);
  boost::polygon::voronoi_diagram<double> diagram;
  builder.construct(&diagram);
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(2 * points.size());
  for (const auto& vertex : diagram.vertices()) {  // its cells' points lie on a circle around it
    const auto* first = vertex.incident_edge();
    std::vector<int> around;
    const auto* edge = first;
    do {
      around.push_back(static_cast<int>(edge->cell()->source_index()));
      edge = edge->rot_next();
    } while (edge != first);
    for (std::size_t i = 1; i + 1 < around.size(); ++i) {
      std::array<int, 3> t = {around[0], around[i], around[i + 1]};
      const auto at = [&](int k) { return points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
      if (doubled_area(at(0), at(1), at(2)) < 0) std::swap(t[1], t[2]);
      triangles.push_back(t);
    }
  }
  return triangles;
}

}  // namespace porosph::render
