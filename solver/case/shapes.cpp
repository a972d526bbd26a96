#include "solver/case/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost 1.74 announces one of its own
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <optional>

namespace porosph {
namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint>;
using BoostSegment = bg::model::segment<BoostPoint>;

BoostPoint boost_point(const Point& p) { return {p.x(), p.y()}; }

BoostPolygon boost_polygon(const Polygon& outline, const std::vector<Polygon>& holes = {}) {
  BoostPolygon polygon;
  for (const Point& p : outline) polygon.outer().push_back(boost_point(p));
  for (const Polygon& hole : holes) {
    polygon.inners().emplace_back();
    for (const Point& p : hole) polygon.inners().back().push_back(boost_point(p));
  }
  bg::correct(polygon);
  return polygon;
}
BoostPolygon boost_polygon(const SoilCase& soil) { return boost_polygon(soil.polygon, soil.holes); }

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

// Where an outline without repeated points touches itself: a fold back at a corner, or edges that meet.
std::optional<Point> self_contact(const Polygon& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point in = p[(i + 1) % n] - p[i], out = p[(i + 2) % n] - p[(i + 1) % n];
    if (cross(in, out) == 0 && in.dot(out) < 0) return p[(i + 1) % n];
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j + 1 == n) continue;  // neighbours
      const auto points = crossings(p[i], p[i + 1], p[j], p[(j + 1) % n]);
      if (!points.empty()) return points.front();
    }
  return std::nullopt;
}

bool is_flat(const Polygon& p) {
  return std::all_of(p.begin(), p.end(), [&](const Point& q) {
    return std::abs(cross(p[1] - p[0], q - p[0])) <= 1e-12 * (p[1] - p[0]).norm() * (q - p[0]).norm();
  });
}

Point point(const BoostPoint& p) { return {p.x(), p.y()}; }

// How much of the segment from a to b looks across less than `width` at `other`, with none of the soils
// between. What the segment is an outline of lies on its right.
Slit slit_along(const Point& a, const Point& b, const BoostPolygon& other,
                const std::vector<BoostPolygon>& soils, double width) {
  if (bg::distance(BoostSegment(boost_point(a), boost_point(b)), other) >= width) return {};
  const double length = (b - a).norm();
  const double pieces =
      std::clamp(std::ceil(2 * length / width), 1., 200.);  // enough to find one on a long edge
  const Point outward = Point(a.y() - b.y(), b.x() - a.x()) / length;
  int found = 0;
  Point place = Point::Zero();
  for (int k = 0; k < pieces; ++k) {
    const Point p = a + (b - a) * ((k + 0.5) / pieces);
    const double gap = bg::distance(boost_point(p), other);
    if (gap <= 1e-3 * width || gap >= width) continue;
    const BoostPoint halfway = boost_point(p + 0.5 * gap * outward);
    const BoostPoint beyond = boost_point(p + 1.1 * gap * outward);  // of an edge askew by up to 24 degrees
    const bool is_slit =
        bg::within(beyond, other) &&
        std::none_of(soils.begin(), soils.end(), [&](const auto& soil) { return bg::within(halfway, soil); });
    if (is_slit && found++ == 0) place = p + 0.5 * gap * outward;
  }
  return {found * std::min(length / pieces, width / 2), place};
}

std::vector<const Polygon*> rings(const SoilCase& soil) {
  std::vector<const Polygon*> all{&soil.polygon};
  for (const Polygon& hole : soil.holes) all.push_back(&hole);
  return all;
}

}  // namespace

std::string outline_fault(const Polygon& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (outline[i] == outline[(i + 1) % outline.size()])
      return i + 1 < outline.size() ? fmt::format("points {} and {} (from 0) are the same", i, i + 1)
                                    : std::string("its last point repeats the first: leave it out");
  if (is_flat(outline)) return "has no area: its points lie in one line";
  std::string message;
  if (bg::is_valid(boost_polygon(outline), message)) return "";
  const auto contact = self_contact(outline);
  return contact ? fmt::format("crosses or touches itself at ({:.10g}, {:.10g})", contact->x(), contact->y())
                 : message;
}

std::string holes_fault(const SoilCase& soil) {
  if (soil.holes.empty()) return "";
  const BoostPolygon outline = boost_polygon(soil.polygon);
  for (std::size_t i = 0; i < soil.holes.size(); ++i)
    if (!bg::within(boost_polygon(soil.holes[i]), outline))
      return fmt::format("hole {} (from 0) is not inside the polygon", i);
  for (std::size_t i = 0; i < soil.holes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (bg::intersects(boost_polygon(soil.holes[i]), boost_polygon(soil.holes[j])))
        return fmt::format("holes {} and {} (from 0) touch or overlap", j, i);
  return bg::is_valid(boost_polygon(soil)) ? "" : "a hole touches the polygon";
}

double area(const SoilCase& soil) { return bg::area(boost_polygon(soil)); }

double thickness(const Polygon& outline) {
  BoostPolygon hull;
  bg::convex_hull(boost_polygon(outline), hull);
  const auto& ring = hull.outer();
  double least = never;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const Point start(ring[i].x(), ring[i].y()), edge = Point(ring[i + 1].x(), ring[i + 1].y()) - start;
    double width = 0;
    for (const auto& p : ring) width = std::max(width, std::abs(cross(edge, Point(p.x(), p.y()) - start)));
    least = std::min(least, width / edge.norm());
  }
  return least;
}

Overlap overlap(const SoilCase& a, const SoilCase& b) {
  bg::model::multi_polygon<BoostPolygon> common;
  bg::intersection(boost_polygon(a), boost_polygon(b), common);
  if (common.empty()) return {};
  const auto box = bg::return_envelope<bg::model::box<BoostPoint>>(common);
  return {bg::area(common), point(box.min_corner()), point(box.max_corner())};
}

std::vector<SoilCase> parts_of(const SoilCase& soil, const Polygon& outline, bool inside, double least) {
  bg::model::multi_polygon<BoostPolygon> parts;
  const BoostPolygon whole = boost_polygon(soil), cutter = boost_polygon(outline);
  if (inside)
    bg::intersection(whole, cutter, parts);
  else
    bg::difference(whole, cutter, parts);
  const auto open_ring = [](const auto& ring) {
    Polygon open;
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) open.push_back(point(ring[i]));
    return open;
  };
  std::vector<SoilCase> soils;
  for (const BoostPolygon& part : parts) {
    if (bg::area(part) <= least) continue;
    SoilCase& piece = soils.emplace_back(soil);
    piece.polygon = open_ring(part.outer());
    piece.holes.clear();
    for (const auto& hole : part.inners()) piece.holes.push_back(open_ring(hole));
  }
  const bool whole_soil = soils.size() == 1 && std::abs(bg::area(whole) - area(soils[0])) <= least;
  if (whole_soil) soils[0] = soil;  // as it was drawn
  return soils;
}

double highest_point(const SoilCase& soil) {
  double y = -never;
  for (const Point& p : soil.polygon) y = std::max(y, p.y());
  return y;
}

double distance(const SoilCase& a, const SoilCase& b) {
  return bg::distance(boost_polygon(a), boost_polygon(b));
}

std::pair<Point, Point> nearest_points(const SoilCase& a, const SoilCase& b) {
  double least = never;
  std::pair<Point, Point> nearest;
  const auto look = [&](const SoilCase& corners, const SoilCase& edges, bool swapped) {
    for (const Polygon* from : rings(corners))
      for (const Point& p : *from)
        for (const Polygon* ring : rings(edges))
          for (std::size_t i = 0; i < ring->size(); ++i) {
            const Point& start = (*ring)[i];
            const Point line = (*ring)[(i + 1) % ring->size()] - start;
            const Point q = start + std::clamp((p - start).dot(line) / line.squaredNorm(), 0., 1.) * line;
            if ((p - q).norm() >= least) continue;
            least = (p - q).norm();
            nearest = swapped ? std::pair(q, p) : std::pair(p, q);
          }
  };
  look(a, b, false), look(b, a, true);  // of two segments apart, one end is nearest
  return nearest;
}

double distance(const Point& point, const SoilCase& soil) {
  return bg::distance(boost_point(point), boost_polygon(soil));
}

Slit find_slit(const std::vector<SoilCase>& soils, std::size_t i, std::size_t j, double width) {
  std::vector<BoostPolygon> polygons;
  for (const SoilCase& soil : soils) polygons.push_back(boost_polygon(soil));
  Slit found;
  const auto look_along = [&](const auto& ring) {
    for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
      const Slit here = slit_along(point(ring[k]), point(ring[k + 1]), polygons[j], polygons, width);
      if (found.length == 0) found.place = here.place;
      found.length += here.length;
    }
  };
  look_along(polygons[i].outer());
  for (const auto& hole : polygons[i].inners()) look_along(hole);
  return found;
}

std::vector<Point> crossings(const Point& a, const Point& b, const Point& c, const Point& d) {
  bg::model::multi_point<BoostPoint> points;
  bg::intersection(BoostSegment(boost_point(a), boost_point(b)), BoostSegment(boost_point(c), boost_point(d)),
                   points);
  std::vector<Point> result;
  for (const auto& p : points) result.emplace_back(p.x(), p.y());
  return result;
}

double distance(const Point& a, const Point& b, const Point& c, const Point& d) {
  return bg::distance(BoostSegment(boost_point(a), boost_point(b)),
                      BoostSegment(boost_point(c), boost_point(d)));
}

}  // namespace porosph
