#include "solver/case/outline_edges.hpp"

#include <algorithm>
#include <cmath>

namespace porosph {
namespace {

/// Whether the segment from c to d covers part of the edge.
bool covers(const Point& c, const Point& d, const OutlineEdge& edge, double tolerance) {
  const Point line = edge.b - edge.a;
  const double length = line.norm();
  const Point along = line / length, across(-along.y(), along.x());
  if (std::abs(across.dot(c - edge.a)) > tolerance || std::abs(across.dot(d - edge.a)) > tolerance)
    return false;
  const auto [from, to] = std::minmax({along.dot(c - edge.a), along.dot(d - edge.a)});
  return std::min(to, length) - std::max(from, 0.0) > tolerance;
}

}  // namespace

std::vector<OutlineEdge> outline_edges(const std::vector<std::vector<Polygon>>& rings_of_soils) {
  std::vector<OutlineEdge> edges;
  for (std::size_t soil = 0; soil < rings_of_soils.size(); ++soil)
    for (const Polygon& ring : rings_of_soils[soil])
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
        edges.push_back({ring[j], ring[i], soil});
  return edges;
}

std::vector<OutlineEdge> outline_edges(const std::vector<SoilCase>& soils) {
  std::vector<std::vector<Polygon>> rings;
  for (const SoilCase& soil : soils) {
    rings.push_back({soil.polygon});
    rings.back().insert(rings.back().end(), soil.holes.begin(), soil.holes.end());
  }
  return outline_edges(rings);
}

bool is_free(const OutlineEdge& edge, const std::vector<OutlineEdge>& edges,
             const std::vector<BoundaryCase>& walls, double tolerance) {
  return std::ranges::none_of(
             walls, [&](const BoundaryCase& wall) { return covers(wall.from, wall.to, edge, tolerance); }) &&
         std::ranges::none_of(edges, [&](const OutlineEdge& other) {
           return other.soil != edge.soil && covers(other.a, other.b, edge, tolerance);
         });
}

Arrangement arrangement_for(const Case& scene) {
  const double tolerance = 1e-6 * scene.particles.spacing;
  const std::vector<OutlineEdge> edges = outline_edges(scene.soils);
  const bool level = std::ranges::all_of(edges, [&](const OutlineEdge& e) {
    if (std::abs(e.a.y() - e.b.y()) <= tolerance) return true;
    return std::abs(e.a.x() - e.b.x()) <= tolerance && !is_free(e, edges, scene.boundaries, tolerance);
  });
  return level ? Arrangement::surface : Arrangement::stretched;
}

}  // namespace porosph
