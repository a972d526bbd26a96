#include "app/read_drawing/regions.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

namespace porosph::drawn {
namespace {

using Json = nlohmann::ordered_json;
using Geometry = std::unique_ptr<OGRGeometry>;
struct Place {
  double x = 0, y = 0;
  auto operator<=>(const Place&) const = default;
};
using Piece = std::vector<Place>;  // of a line, between two nodes

OGRMultiLineString lines_of(const Json& all) {
  OGRMultiLineString lines;
  for (const Json& points : all) {
    OGRLineString line;
    for (const Json& p : points) line.addPoint(p.at(0).get<double>(), p.at(1).get<double>());
    if (line.getNumPoints() > 1) lines.addGeometry(&line);
  }
  return lines;
}

Json ring_of(const OGRLinearRing& ring) {
  Json points = Json::array();
  for (const OGRPoint& p : ring) points.push_back({p.getX(), p.getY()});
  return points;
}

Json regions_of(const OGRGeometry& polygons) {
  Json regions = Json::array();
  for (const OGRGeometry* part : *polygons.toGeometryCollection()) {
    Json rings = Json::array();
    for (const OGRLinearRing* ring : *part->toPolygon()) rings.push_back(ring_of(*ring));
    regions.push_back(std::move(rings));
  }
  return regions;
}

void add_pieces(const OGRGeometry& noded, std::vector<Piece>& pieces) {
  if (OGR_GT_IsSubClassOf(wkbFlatten(noded.getGeometryType()), wkbGeometryCollection)) {
    for (const OGRGeometry* part : *noded.toGeometryCollection()) add_pieces(*part, pieces);
  } else if (wkbFlatten(noded.getGeometryType()) == wkbLineString) {
    Piece piece;
    for (const OGRPoint& p : *noded.toLineString()) piece.push_back({p.getX(), p.getY()});
    pieces.push_back(std::move(piece));
  }
}

double distance(const Place& p, const Piece& piece) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < piece.size(); ++i) {
    const auto [ax, ay] = piece[i];
    const double dx = piece[i + 1].x - ax, dy = piece[i + 1].y - ay, squared = dx * dx + dy * dy;
    const double t = squared > 0 ? std::clamp(((p.x - ax) * dx + (p.y - ay) * dy) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, std::hypot(p.x - ax - t * dx, p.y - ay - t * dy));
  }
  return least;
}

/// Ends that meet nothing. One whose nearest neighbour is what its own piece comes from was drawn too far.
Json gaps_of(const std::vector<Piece>& pieces) {
  std::map<Place, int> met;
  for (const Piece& piece : pieces) ++met[piece.front()], ++met[piece.back()];
  Json gaps = Json::array();
  const auto look = [&](const Piece& own, const Place& end, const Place& origin) {
    if (met[end] > 1) return;
    double nearest = HUGE_VAL;
    bool drawn_too_far = false;
    for (const Piece& other : pieces) {
      const double away = &other == &own ? HUGE_VAL : distance(end, other);
      if (away >= nearest) continue;
      nearest = away;
      drawn_too_far = met[origin] > 2 && (other.front() == origin || other.back() == origin);
    }
    if (!drawn_too_far)
      gaps.push_back({{"at", {end.x, end.y}}, {"gap", std::isfinite(nearest) ? nearest : -1}});
  };
  for (const Piece& piece : pieces) {
    look(piece, piece.front(), piece.back());
    look(piece, piece.back(), piece.front());
  }
  return gaps;
}

}  // namespace

Json regions_between(const Json& asked) {
  if (!OGRGeometryFactory::haveGEOS())
    throw std::runtime_error("lines cannot be joined to regions: GDAL was built without GEOS");
  const OGRMultiLineString lines = lines_of(asked.at("lines"));
  const Geometry noded(lines.Union(&lines));  // cut where they cross
  if (!noded) throw std::runtime_error("lines cannot be cut where they cross");
  std::vector<Piece> pieces;
  add_pieces(*noded, pieces);
  OGRMultiLineString cut;
  for (const Piece& piece : pieces) {
    OGRLineString line;
    for (const auto& [x, y] : piece) line.addPoint(x, y);
    cut.addGeometry(&line);
  }
  const Geometry polygons(cut.Polygonize());
  return {{"regions", polygons ? regions_of(*polygons) : Json::array()}, {"gaps", gaps_of(pieces)}};
}

}  // namespace porosph::drawn
