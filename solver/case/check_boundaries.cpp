#include "solver/case/check_boundaries.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "solver/boundary/support.hpp"
#include "solver/case/shapes.hpp"

namespace porosph {
namespace {

struct Side {
  bool left = false, right = false;
  std::string soil;  ///< the last one found
};

Point unit(const BoundaryCase& b) { return (b.to - b.from).normalized(); }
std::string name(std::size_t i) { return fmt::format("boundary[{}]", i); }
std::string text(const Point& p) { return fmt::format("({}, {})", p.x(), p.y()); }

// Where along a boundary (0 to 1) the outlines of the soils begin, end or cross it.
std::vector<double> cuts(const Case& c, const BoundaryCase& b, double tolerance) {
  const Point along = b.to - b.from;
  std::vector<double> result{0, 1};
  const auto add = [&](const Point& p) {
    result.push_back(std::clamp((p - b.from).dot(along) / along.squaredNorm(), 0., 1.));
  };
  const auto add_outline = [&](const Polygon& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Point &p = outline[i], &q = outline[(i + 1) % outline.size()];
      if (distance(p, q, b.from, b.to) > tolerance) continue;
      add(p), add(q);
      for (const Point& crossing : crossings(p, q, b.from, b.to)) add(crossing);
    }
  };
  for (const SoilCase& soil : c.soils) {
    add_outline(soil.polygon);
    for (const Polygon& hole : soil.holes) add_outline(hole);
  }
  std::sort(result.begin(), result.end());
  return result;
}

Side sides(const Case& c, const BoundaryCase& b, const Point& at, double tolerance) {
  const Point across = Point(-unit(b).y(), unit(b).x()) * tolerance;
  Side side;
  for (const SoilCase& soil : c.soils) {
    const bool left = distance(Point(at + across), soil) == 0,
               right = distance(Point(at - across), soil) == 0;
    if (left || right) side.soil = soil.name;
    side.left |= left;
    side.right |= right;
  }
  return side;
}

constexpr const char* beside_no_soil = "does not lie on the outline of any soil";

// Walks along a boundary: soil must lie on one side of it, the same all along, and somewhere.
std::string fault_along(const Case& c, const BoundaryCase& b, double tolerance) {
  const double length = (b.to - b.from).norm();
  const std::vector<double> t = cuts(c, b, tolerance);
  Side all;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    if ((t[i + 1] - t[i]) * length < 2 * tolerance) continue;
    const Point at = b.from + (b.to - b.from) * (t[i] + t[i + 1]) / 2;
    const Side here = sides(c, b, at, tolerance);
    if (here.left && here.right)
      return fmt::format("has soil on both sides at {} (soil '{}')", text(at), here.soil);
    all.left |= here.left;
    all.right |= here.right;
  }
  if (all.left && all.right) return "has soil on its left and, further along, on its right: split it";
  return all.left || all.right ? "" : beside_no_soil;
}

// The angle of the soil in the corner of two boundaries, where they are not in one line [degrees]; 180 where
// no soil lies between them.
double angle_of_soil(const Case& c, const BoundaryCase& a, const BoundaryCase& b, double tolerance) {
  const Point u = unit(a), v = unit(b), between = b.from - a.from;
  const double along = (between.x() * v.y() - between.y() * v.x()) / (u.x() * v.y() - u.y() * v.x());
  const Point corner = a.from + along * u;
  const auto ways = [&](const BoundaryCase& boundary) {
    std::vector<Point> found;
    for (const Point& end : {boundary.from, boundary.to})
      if ((end - corner).norm() > tolerance) found.push_back((end - corner).normalized());
    return found;
  };
  double least = 180;
  for (const Point& p : ways(a))
    for (const Point& q : ways(b)) {
      const Point inside = corner + 10 * tolerance * (p + q).normalized();
      const auto holds = [&](const SoilCase& soil) { return distance(inside, soil) == 0; };
      if (std::any_of(c.soils.begin(), c.soils.end(), holds))
        least = std::min(least, std::acos(std::clamp(p.dot(q), -1.0, 1.0)) * 180 / std::numbers::pi);
    }
  return least;
}

std::string fault_of_pair(const Case& c, const BoundaryCase& a, const BoundaryCase& b, double tolerance) {
  if (distance(a.from, a.to, b.from, b.to) > tolerance) return "";
  constexpr double in_line = 1e-4;  // the sine of an angle that counts as none
  const Point u = unit(a), v = unit(b);
  const double sine = u.x() * v.y() - u.y() * v.x();
  if (std::abs(sine) > in_line) {
    constexpr double sharpest = 30;  // degrees
    const double angle = angle_of_soil(c, a, b, tolerance);
    return angle >= sharpest - 1e-6 ? ""
                                    : fmt::format(
                                          "at an angle of {:.4g} degrees: the soil between them must "
                                          "have {} degrees or more",
                                          angle, sharpest);
  }
  const double b0 = u.dot(b.from - a.from), b1 = u.dot(b.to - a.from), length = (a.to - a.from).norm();
  const double common = std::min(length, std::max(b0, b1)) - std::max(0., std::min(b0, b1));
  return common > tolerance ? fmt::format("along {:.4g} m: must be one or the other", common) : "";
}

// Soils of one body have the same number: the smallest index among them.
std::vector<std::size_t> bodies(const Case& c, double tolerance) {
  std::vector<std::size_t> body(c.soils.size());
  std::iota(body.begin(), body.end(), 0u);
  for (std::size_t i = 0; i < body.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (body[i] != body[j] && distance(c.soils[i], c.soils[j]) < tolerance) {
        const auto [low, high] = std::minmax(body[i], body[j]);
        std::replace(body.begin(), body.end(), std::size_t(high), std::size_t(low));
      }
  return body;
}

/// Where the soil slides it is held only across: an upright boundary of that kind carries nothing.
bool carries(const BoundaryCase& b, const SoilCase& soil, const Case& c, double tolerance) {
  if (!support_of(b.kind).carries_shear() && std::abs(unit(b).x()) < 1e-4) return false;
  Case alone = c;
  alone.soils = {soil};
  return fault_along(alone, b, tolerance).empty();
}

// Whether soil of another body lies below any soil of this one.
bool lands(const Case& c, const std::vector<std::size_t>& body, std::size_t number) {
  const auto box = [](const SoilCase& soil) {
    Eigen::AlignedBox2d around;
    for (const Point& p : soil.polygon) around.extend(p);
    return around;
  };
  for (std::size_t i = 0; i < body.size(); ++i)
    for (std::size_t j = 0; j < body.size(); ++j) {
      if (body[i] != number || body[j] == number) continue;
      const Eigen::AlignedBox2d own = box(c.soils[i]), other = box(c.soils[j]);
      const double common =
          std::min(own.max().x(), other.max().x()) - std::max(own.min().x(), other.min().x());
      if (common > c.particles.spacing && other.min().y() < own.min().y()) return true;
    }
  return false;
}

// Of each body, by its number.
std::vector<bool> carried_bodies(const Case& c, const std::vector<std::size_t>& body, double tolerance) {
  std::vector<bool> carried(body.size(), false);
  for (std::size_t i = 0; i < body.size(); ++i)
    for (const BoundaryCase& b : c.boundaries)
      if (!carried[body[i]] && carries(b, c.soils[i], c, tolerance)) carried[body[i]] = true;
  return carried;
}

std::vector<CaseIssue> unsupported(const Case& c, double tolerance) {
  std::vector<CaseIssue> issues;
  const std::vector<std::size_t> body = bodies(c, tolerance);
  const std::vector<bool> carried = carried_bodies(c, body, tolerance);
  for (std::size_t first = 0; first < body.size(); ++first)
    if (body[first] == first && !carried[first] && !lands(c, body, first))
      issues.push_back(
          {fmt::format("soil[{}]", first),
           fmt::format("soil '{}' falls: gravity is applied and its body has no boundary that carries it, a "
                       "fixed one or a roller that is not upright, and no soil below to land on",
                       c.soils[first].name)});
  return issues;
}

}  // namespace

std::vector<bool> falling_soils(const Case& c) {
  std::vector<bool> falls(c.soils.size(), false);
  if (!c.loading.gravity_applied) return falls;
  const double tolerance = 1e-3 * c.particles.spacing;
  const std::vector<std::size_t> body = bodies(c, tolerance);
  const std::vector<bool> carried = carried_bodies(c, body, tolerance);
  for (std::size_t i = 0; i < falls.size(); ++i) falls[i] = !carried[body[i]] && lands(c, body, body[i]);
  return falls;
}

bool lies_on_soil(const Case& c, const BoundaryCase& b) {
  return fault_along(c, b, 1e-3 * c.particles.spacing) != beside_no_soil;
}

std::vector<CaseIssue> check_boundaries(const Case& c) {
  const double tolerance = 1e-3 * c.particles.spacing;
  std::vector<CaseIssue> issues;
  for (std::size_t i = 0; i < c.boundaries.size(); ++i) {
    const BoundaryCase& b = c.boundaries[i];
    if ((b.to - b.from).norm() < c.particles.spacing)
      issues.push_back({name(i), fmt::format("is shorter than the spacing of {} m", c.particles.spacing)});
  }
  if (!issues.empty()) return issues;

  for (std::size_t i = 0; i < c.boundaries.size(); ++i) {
    const std::string fault = fault_along(c, c.boundaries[i], tolerance);
    if (!fault.empty()) issues.push_back({name(i), fault});
  }
  if (!issues.empty()) return issues;

  for (std::size_t i = 0; i < c.boundaries.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::string fault = fault_of_pair(c, c.boundaries[j], c.boundaries[i], tolerance);
      if (!fault.empty()) issues.push_back({name(i), fmt::format("meets {} {}", name(j), fault)});
    }
  if (c.loading.gravity_applied && issues.empty()) issues = unsupported(c, tolerance);
  return issues;
}

}  // namespace porosph
