#include "solver/case/check_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/case/outline_edges.hpp"

namespace porosph {
namespace {

using Issues = std::vector<CaseIssue>;

bool is_periodic(const BoundaryCase& b) { return b.kind == BoundaryKind::periodic; }
std::string kind_of(std::size_t i) { return fmt::format("boundary[{}].kind", i); }

/// What a case with periodic sides must not have; empty if nothing.
std::string obstacle_to_periodic(const Case& c) {
  if (c.formulation.motion != Motion::consistent) return "needs formulation.motion = \"consistent\"";
  if (c.water.mode == WaterMode::steady || c.water.mode == WaterMode::transient)
    return fmt::format("cannot be combined with water.mode = \"{}\"", name(c.water.mode));
  if (!c.stages.empty() || !c.start_from.empty()) return "cannot be combined with stages and start_from";
  if (!c.sheets.empty()) return "cannot be combined with sheets";
  return "";
}

std::string obstacle_to_shaking(const Case& c) {
  if (c.water.steps_by_flow()) return "needs soil that moves: water.motion = \"dynamic\"";
  if (!c.sheets.empty()) return "cannot be combined with sheets, which it would not shake";
  return "";
}

/// Left and right end of all soils [m].
std::pair<double, double> ends_of(const Case& c) {
  double left = never, right = -never;
  for (const SoilCase& soil : c.soils)
    for (const Point& p : soil.polygon) left = std::min(left, p.x()), right = std::max(right, p.x());
  return {left, right};
}

/// Pieces of the soils' outlines along an upright line: from, to and the soil's number, in that order.
struct Piece {
  double from, to;
  int soil;
};
std::vector<Piece> pieces_along(const Case& c, double x, double tolerance) {
  std::vector<Piece> pieces;
  for (const OutlineEdge& e : outline_edges(c.soils)) {
    if (std::abs(e.a.x() - x) > tolerance || std::abs(e.b.x() - x) > tolerance) continue;
    const auto [low, high] = std::minmax(e.a.y(), e.b.y());
    pieces.push_back({low, high, static_cast<int>(e.soil)});
  }
  std::ranges::sort(pieces, {}, &Piece::from);
  return pieces;
}

bool are_alike(const std::vector<Piece>& a, const std::vector<Piece>& b, double tolerance) {
  return std::ranges::equal(a, b, [&](const Piece& p, const Piece& q) {
    return p.soil == q.soil && std::abs(p.from - q.from) <= tolerance && std::abs(p.to - q.to) <= tolerance;
  });
}

/// What is wrong with one side; empty if nothing.
std::string fault_of_side(const Case& c, const BoundaryCase& b, double tolerance) {
  if (std::abs(b.from.x() - b.to.x()) > tolerance) return "must be upright";
  const auto [left, right] = ends_of(c);
  if (std::abs(b.from.x() - left) > tolerance && std::abs(b.from.x() - right) > tolerance)
    return fmt::format("must be where the soils end, at x = {:g} or {:g} m", left, right);
  const std::vector<Piece> pieces = pieces_along(c, b.from.x(), tolerance);
  const auto [low, high] = std::minmax(b.from.y(), b.to.y());
  if (!pieces.empty() && (low > pieces.front().from + tolerance || high < pieces.back().to - tolerance))
    return fmt::format("must cover the whole side, from y = {:g} to {:g} m", pieces.front().from,
                       pieces.back().to);
  return "";
}

std::string fault_of_pair(const Case& c, const BoundaryCase& a, const BoundaryCase& b, double tolerance) {
  const double apart = std::abs(a.from.x() - b.from.x()),
               least = 2 * c.smoothing_length() + c.particles.spacing;
  if (apart < tolerance) return "must be at the other end of the soils";
  if (apart < least - tolerance)
    return fmt::format(
        "is {:g} m from the other periodic side: must be {:g} m or more, so that no particle is its "
        "own neighbour",
        apart, least);
  if (!are_alike(pieces_along(c, a.from.x(), tolerance), pieces_along(c, b.from.x(), tolerance), tolerance))
    return "must have the same soils at the same heights as the other periodic side";
  return "";
}

}  // namespace

Issues check_sides_settings(const Case& c) {
  Issues issues;
  for (std::size_t i = 0; i < c.boundaries.size(); ++i) {
    if (!is_periodic(c.boundaries[i])) continue;
    if (const std::string obstacle = obstacle_to_periodic(c); !obstacle.empty())
      issues.push_back({kind_of(i), "\"periodic\" " + obstacle});
    break;
  }
  if (c.shaking.acts())
    if (const std::string obstacle = obstacle_to_shaking(c); !obstacle.empty())
      issues.push_back({"shaking", obstacle});
  return issues;
}

Issues check_periodic_sides(const Case& c) {
  const double tolerance = 1e-3 * c.particles.spacing;
  std::vector<std::size_t> sides;
  for (std::size_t i = 0; i < c.boundaries.size(); ++i)
    if (is_periodic(c.boundaries[i])) sides.push_back(i);
  if (sides.empty()) return {};
  if (sides.size() != 2)
    return {{kind_of(sides.back()), fmt::format("\"periodic\" joins two sides, but there {} {}",
                                                sides.size() == 1 ? "is" : "are", sides.size())}};
  for (const std::size_t i : sides)
    if (const std::string fault = fault_of_side(c, c.boundaries[i], tolerance); !fault.empty())
      return {{fmt::format("boundary[{}]", i), "is periodic: it " + fault}};
  const std::string fault = fault_of_pair(c, c.boundaries[sides[0]], c.boundaries[sides[1]], tolerance);
  if (!fault.empty()) return {{fmt::format("boundary[{}]", sides[1]), "is periodic: it " + fault}};
  return {};
}

}  // namespace porosph
