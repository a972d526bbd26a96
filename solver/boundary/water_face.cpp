#include "solver/boundary/water_face.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "solver/case/outline_edges.hpp"
#include "solver/case/shapes.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {
namespace {

constexpr double touching = 1e-3;  // spacings up to which water that ends beside a face touches it

/// A piece of an outline before particles are found for it, with soil on its left.
struct Piece {
  Vec2 from, to;
  Vec2 outward;
  int outside = -1;
};

/// Cuts the edges into pieces, and keeps those that lie beside water or beside the end of it.
std::vector<Piece> cut_edges(const Case& scene) {
  const double spacing = scene.particles.spacing, beside = touching * spacing;
  const std::vector<OutlineEdge> edges = outline_edges(scene.soils);
  std::vector<Piece> pieces;
  for (const OutlineEdge& edge : edges) {
    const Vec2 line = edge.b - edge.a, right = Vec2(line.y(), -line.x()).normalized();
    const Vec2 middle = (edge.a + edge.b) / 2;
    const bool soil_on_the_right = distance(Vec2(middle + beside * right), scene.soils[edge.soil]) == 0;
    const Vec2 outward = soil_on_the_right ? Vec2(-right) : right;
    const Vec2 from = soil_on_the_right ? edge.b : edge.a, way = soil_on_the_right ? Vec2(-line) : line;
    const double count = std::ceil(2 * line.norm() / spacing);
    for (int k = 0; k < count; ++k) {
      const Piece piece{from + way * (k / count), from + way * ((k + 1) / count), outward};
      const Vec2 beyond = (piece.from + piece.to) / 2 + beside * outward;
      const int outside = stretch_at(scene.water.stretches, beyond.x());
      if (outside >= 0 && is_free({piece.from, piece.to, edge.soil}, edges, scene.boundaries, beside))
        pieces.push_back({piece.from, piece.to, outward, outside});
    }
  }
  return pieces;
}

bool ends_somewhere(const WaterCase& water) {
  return std::ranges::any_of(water.stretches,
                             [](const WaterStretch& s) { return s.x_from > -never || s.x_to < never; });
}

}  // namespace

Vec2 WaterOnFace::traction(const Vec2& place, const Vec2& normal, double time) const {
  return (standing_.pore_pressure_under(outside_, place.y(), time) -
          standing_.pore_pressure_under(inside_, place.y(), time)) *
         normal;
}

std::vector<LoadedSurface> water_faces(const Case& scene, const Particles& p, double radius) {
  if (!ends_somewhere(scene.water)) return {};
  const double beside = 2 * touching * scene.particles.spacing;
  const std::vector<Piece> pieces = cut_edges(scene);
  std::vector<Vec2> middles;
  for (const Piece& piece : pieces) middles.emplace_back((piece.from + piece.to) / 2);
  const NeighbourList near = find_neighbours(middles, p.position, radius);
  std::map<std::pair<int, int>, LoadedSurface> surfaces;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto found = near.of(i);
    if (found.empty()) continue;
    const std::int32_t nearest = *std::ranges::min_element(
        found, {}, [&](std::int32_t b) { return (p.position[b] - middles[i]).squaredNorm(); });
    const Vec2 within = p.position[nearest] - beside * pieces[i].outward;  // it may lie on the face
    const int outside = pieces[i].outside, inside = stretch_at(scene.water.stretches, within.x());
    if (inside == outside) continue;
    LoadedSurface& surface = surfaces[{outside, inside}];
    if (!surface.load) surface.load = std::make_shared<WaterOnFace>(scene.water, outside, inside);
    surface.pieces.push_back(surface_piece(pieces[i].from, pieces[i].to, found, p, radius / 2));
  }
  std::vector<LoadedSurface> faces;
  for (auto& [stretches, surface] : surfaces) faces.push_back(std::move(surface));
  return faces;
}

}  // namespace porosph
