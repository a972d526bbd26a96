#include "solver/geometry/region.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solver/geometry/moments.hpp"

namespace porosph {
namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint, false, false>;  // counter-clockwise, open

BoostPoint boost_point(const Point& p) { return {p.x(), p.y()}; }

BoostPolygon boost_polygon(const std::vector<Polygon>& rings) {
  BoostPolygon polygon;
  polygon.inners().resize(rings.size() - 1);
  for (std::size_t i = 0; i < rings.size(); ++i)
    std::ranges::transform(rings[i], std::back_inserter(i == 0 ? polygon.outer() : polygon.inners()[i - 1]),
                           boost_point);
  return polygon;
}

double distance(const Point& p, const Polygon& ring) {
  double nearest = never;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const bg::model::segment<BoostPoint> edge(boost_point(ring[j]), boost_point(ring[i]));
    nearest = std::min(nearest, bg::distance(boost_point(p), edge));
  }
  return nearest;
}

/// Whether a ray to the right crosses the rings an odd number of times.
bool strictly_inside(const Point& p, const std::vector<Polygon>& rings) {
  bool inside = false;
  for (const Polygon& ring : rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Point &a = ring[j], &b = ring[i];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
  return inside;
}

}  // namespace

Region::Region(Polygon outline, std::vector<Polygon> holes) : rings_{std::move(outline)} {
  std::move(holes.begin(), holes.end(), std::back_inserter(rings_));
  for (const Polygon& ring : rings_)
    if (ring.size() < 3) throw std::invalid_argument("a polygon needs at least three points");
  for (std::size_t i = 0; i < rings_.size(); ++i)
    if ((moments({rings_[i]}, rings_[i].front()).area > 0) != (i == 0)) std::ranges::reverse(rings_[i]);

  std::string reason;
  if (!bg::is_valid(boost_polygon(rings_), reason))
    throw std::invalid_argument("not a simple polygon with holes inside of it: " + reason);

  lower_left_ = upper_right_ = rings_.front().front();
  for (const Point& p : rings_.front()) {
    lower_left_ = lower_left_.cwiseMin(p);
    upper_right_ = upper_right_.cwiseMax(p);
  }
}

double Region::area() const { return moments(rings_, lower_left_).area; }

Point Region::centroid() const {
  const Moments m = moments(rings_, lower_left_);
  return lower_left_ + m.first / m.area;
}

double Region::distance_to_outline(const Point& p) const {
  double nearest = never;
  for (const Polygon& ring : rings_) nearest = std::min(nearest, distance(p, ring));
  return nearest;
}

bool Region::contains(const Point& p) const {
  return distance_to_outline(p) <= 1e-9 * size() || strictly_inside(p, rings_);
}

std::vector<std::vector<Polygon>> Region::parts_within(const Point& low, const Point& high) const {
  const bg::model::box<BoostPoint> box(boost_point(low), boost_point(high));
  bg::model::multi_polygon<BoostPolygon> common;
  bg::intersection(boost_polygon(rings_), box, common);
  std::vector<std::vector<Polygon>> parts;
  for (const BoostPolygon& part : common) {
    std::vector<Polygon>& rings = parts.emplace_back();
    const auto append = [&](const auto& ring) {
      Polygon& points = rings.emplace_back();
      for (const BoostPoint& p : ring) points.emplace_back(p.x(), p.y());
    };
    append(part.outer());
    for (const auto& hole : part.inners()) append(hole);
  }
  return parts;
}

Point Region::nearest_inside(const Point& p, double depth) const {
  if (strictly_inside(p, rings_) || contains(p)) return p;
  constexpr int directions = 16;
  Point best = p;
  double least = never;
  for (const Polygon& ring : rings_)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Point edge = ring[i] - ring[j];
      const double along = std::clamp((p - ring[j]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      const Point foot = ring[j] + along * edge;
      for (int k = 0; k < directions; ++k) {
        const double angle = 2 * std::numbers::pi * k / directions;
        const Point place = foot + depth * Point(std::cos(angle), std::sin(angle));
        const double away = (place - p).norm();
        if (away < least && strictly_inside(place, rings_) && distance_to_outline(place) > 0.5 * depth)
          best = place, least = away;
      }
    }
  return best;
}

double Region::overlap(const Region& other) const {
  bg::model::multi_polygon<BoostPolygon> common;
  bg::intersection(boost_polygon(rings_), boost_polygon(other.rings_), common);
  return bg::area(common);
}

}  // namespace porosph
