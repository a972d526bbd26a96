#include "solver/case/check_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/case/outline_edges.hpp"

namespace porosph {
namespace {

/// How much of the segment from a to b the edge covers [m].
double common_length(const Point& a, const Point& b, const Point& c, const Point& d, double tolerance) {
  const double length = (b - a).norm();
  const Point along = (b - a) / length, across(-along.y(), along.x());
  if (std::abs(across.dot(c - a)) > tolerance || std::abs(across.dot(d - a)) > tolerance) return 0;
  const auto [from, to] = std::minmax({along.dot(c - a), along.dot(d - a)});
  return std::max(0.0, std::min(to, length) - std::max(from, 0.0));
}

/// `what` presses there: "a load".
std::string place_fault(const Case& c, const Point& from, const Point& to, std::string_view what) {
  const double spacing = c.particles.spacing, tolerance = 1e-3 * spacing;
  const double length = (to - from).norm();
  if (length < spacing) return fmt::format("is shorter than the spacing of {} m", spacing);
  double covered = 0;
  for (const OutlineEdge& e : outline_edges(c.soils)) covered += common_length(from, to, e.a, e.b, tolerance);
  if (covered < tolerance) return "does not lie on the outline of any soil";
  if (covered > length + tolerance) return "lies between two soils: it must be on a free surface";
  if (covered < length - tolerance)
    return fmt::format(
        "lies on the outline along {:.4g} of its {:.4g} m only: it must end on one straight stretch", covered,
        length);
  for (std::size_t i = 0; i < c.boundaries.size(); ++i)
    for (const Point& wall_end : {c.boundaries[i].from, c.boundaries[i].to})
      for (const Point& end : {from, to})
        if ((wall_end - end).norm() < 2 * c.smoothing_length())
          return fmt::format(
              "meets the end of boundary[{}] at ({}, {}): a wall beside {} must extend beyond the soil, "
              "by {} m or more, "
              "to hold the particles on the surface",
              i, wall_end.x(), wall_end.y(), what, 2 * c.smoothing_length());
  for (std::size_t i = 0; i < c.boundaries.size(); ++i)
    if (common_length(from, to, c.boundaries[i].from, c.boundaries[i].to, tolerance) > tolerance)
      return fmt::format("lies on boundary[{}]: it must be on a free surface", i);
  return "";
}

bool is_nothing(const LoadCase& load) {
  return load.pressure == 0 && load.pressure_to == 0 && load.traction == Point::Zero() &&
         load.traction_to == Point::Zero();
}

}  // namespace

std::vector<CaseIssue> check_loads(const Case& c) {
  std::vector<CaseIssue> issues;
  for (std::size_t i = 0; i < c.loads.size(); ++i) {
    const std::string key = fmt::format("load[{}]", i);
    if (is_nothing(c.loads[i]))
      issues.push_back(
          {key, fmt::format("load '{}' has neither a pressure nor a traction", c.loads[i].name)});
    if (const std::string fault = place_fault(c, c.loads[i].from, c.loads[i].to, "a load"); !fault.empty())
      issues.push_back({key, fault});
  }
  return issues;
}

bool footing_on_soil_that_may_yield(const Case& c) {
  const auto yields = [](const SoilCase& soil) { return soil.law != LawKind::elastic; };
  return !c.footings.empty() && std::ranges::any_of(c.soils, yields);
}

std::vector<CaseIssue> check_footings(const Case& c) {
  std::vector<CaseIssue> issues;
  for (std::size_t i = 0; i < c.footings.size(); ++i) {
    const FootingCase& footing = c.footings[i];
    const std::string key = fmt::format("footing[{}]", i);
    const bool settles = footing.settlement < never;
    if (settles == (footing.force < never))
      issues.push_back(
          {key, fmt::format("footing '{}' needs one of 'force' and 'settlement'", footing.name)});
    const bool from_nothing = !footing.over_time.empty() && footing.over_time.front().y() == 0 &&
                              footing.over_time.front().x() >= 0;  // later in a stage
    if (settles && !from_nothing)
      issues.push_back(
          {key + ".over_time",
           "must begin with [0, 0]: a footing that is driven by its settlement has none at first"});
    for (const ProbeCase& probe : c.probes)
      if (probe.name == footing.name)
        issues.push_back({key + ".name", fmt::format("'{}' is the name of a probe too", footing.name)});
    if (const std::string fault = place_fault(c, footing.from, footing.to, "a footing"); !fault.empty())
      issues.push_back({key, fault});
    if (c.formulation.motion != Motion::consistent)
      issues.push_back({key, "a footing needs formulation.motion = \"consistent\""});
    if (c.water.couples() && c.water.steps_by_flow() && settles)
      issues.push_back({key + ".settlement",
                        fmt::format("with water.mode = \"{}\" a footing needs 'force'", name(c.water.mode))});
    if (c.water.mode == WaterMode::transient)
      issues.push_back(
          {key, fmt::format("a footing cannot be combined with water.mode = \"{}\"", name(c.water.mode))});
  }
  return issues;
}

}  // namespace porosph
