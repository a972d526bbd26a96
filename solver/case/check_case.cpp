#include "solver/case/check_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/boundary/support.hpp"
#include "solver/case/check_boundaries.hpp"
#include "solver/case/check_flow.hpp"
#include "solver/case/check_loads.hpp"
#include "solver/case/check_sheets.hpp"
#include "solver/case/check_sides.hpp"
#include "solver/case/demand.hpp"
#include "solver/case/fem_obstacle.hpp"
#include "solver/case/inertia.hpp"
#include "solver/case/shapes.hpp"
#include "solver/case/stages.hpp"
#include "solver/space/place_text.hpp"

namespace porosph {
namespace {

using Issues = std::vector<CaseIssue>;
constexpr double most_frames = 1e5;
constexpr double longest_slit = 3;  // spacings that may be bridged at the tip of a notch

std::string at(std::string_view list, std::size_t i, std::string_view key = "") {
  return fmt::format("{}[{}]{}{}", list, i, key.empty() ? "" : ".", key);
}

template <class T>
void check_names(const std::vector<T>& items, std::string_view list, Issues& issues) {
  for (std::size_t i = 0; i < items.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!items[i].name.empty() && items[i].name == items[j].name) {
        issues.push_back({at(list, i, "name"), fmt::format("is the name of {} too", at(list, j))});
        break;
      }
}

struct Box {
  Point low, high;
};

Box box_of(const SoilCase& soil) {
  Box box{soil.polygon[0], soil.polygon[0]};
  for (const Point& p : soil.polygon) box = {box.low.cwiseMin(p), box.high.cwiseMax(p)};
  return box;
}

// Outlines by themselves: what follows relies on them.
void check_outlines(const Case& c, Issues& issues) {
  for (std::size_t i = 0; i < c.soils.size(); ++i) {
    const SoilCase& soil = c.soils[i];
    const std::size_t before = issues.size();
    const auto add = [&](const std::string& key, const std::string& fault) {
      if (!fault.empty()) issues.push_back({key, fault});
    };
    add(at("soil", i, "polygon"), outline_fault(soil.polygon));
    for (std::size_t j = 0; j < soil.holes.size(); ++j)
      add(at("soil", i, at("holes", j)), outline_fault(soil.holes[j]));
    if (issues.size() == before) add(at("soil", i, "holes"), holes_fault(soil));
  }
}

void check_soils(const Case& c, Issues& issues) {
  const double dx = c.particles.spacing;
  for (std::size_t i = 0; i < c.soils.size(); ++i) {
    const double width = thickness(c.soils[i].polygon);
    if (width < dx * (1 - 1e-9))
      issues.push_back({at("soil", i, "polygon"),
                        fmt::format("soil '{}' is {:.4g} m thick, less than particles.spacing = {} m",
                                    c.soils[i].name, width, dx)});
    for (std::size_t j = 0; j < i; ++j) {
      const Overlap common = overlap(c.soils[i], c.soils[j]);
      const double gap = distance(c.soils[i], c.soils[j]);
      if (common.area > 1e-6 * dx * dx) {
        issues.push_back(
            {at("soil", i, "polygon"),
             fmt::format("soils '{}' and '{}' overlap by {:.4g} m2, between {} and {}", c.soils[j].name,
                         c.soils[i].name, common.area, place_text(common.low), place_text(common.high))});
      } else if (gap > 1e-3 * dx && gap < dx * (1 - 1e-9)) {
        issues.push_back(
            {at("soil", i, "polygon"),
             fmt::format("soils '{}' and '{}' are {:.4g} m apart at {}, less than "
                         "particles.spacing = {} m: they must touch, or keep clear of each other",
                         c.soils[j].name, c.soils[i].name, gap,
                         place_text(nearest_points(c.soils[i], c.soils[j]).first), dx)});
      } else if (gap <= 1e-3 * dx) {
        const Slit slit = find_slit(c.soils, i, j, dx);
        if (slit.length > longest_slit * dx)
          issues.push_back(
              {at("soil", i, "polygon"),
               fmt::format("soils '{}' and '{}' leave a slit between them that is narrower than "
                           "particles.spacing = {} m over {:.4g} m, at {}: close it or widen it",
                           c.soils[j].name, c.soils[i].name, dx, slit.length, place_text(slit.place))});
      }
    }
  }
}

void check_size(const Case& c, Issues& issues) {
  const Demand demand = demand_of(c);
  if (!(demand.particles <= most_particles))
    issues.push_back(
        {"particles.spacing",
         fmt::format("makes {:.3g} particles, which need about {:.3g} GB of memory; at most {:.0e}",
                     demand.particles, demand.bytes / 1e9, most_particles)});
  else if (!(demand.steps <= most_steps))
    issues.push_back(
        {"time.end", fmt::format("takes about {:.3g} time steps; at most {:.0e}", demand.steps, most_steps)});
}

void check_water(const Case& c, Issues& issues) {
  const auto& stretches = c.water.stretches;
  for (std::size_t i = 0; i < stretches.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::max(stretches[i].x_from, stretches[j].x_from) < std::min(stretches[i].x_to, stretches[j].x_to))
        issues.push_back({at("water.stretches", i), fmt::format("overlaps {}", at("water.stretches", j))});
}

/// Where a stretch lies beside a soil: the distance, and whether it reaches the soil, over it or at an
/// upright face.
struct Reach {
  double away = never;  // [m]
  bool touches = false;
  std::string soil;
};

Reach reach_of(const WaterStretch& s, const Case& c) {
  const double tolerance = 1e-3 * c.particles.spacing;
  Reach reach;
  for (const SoilCase& soil : c.soils) {
    const auto [low, high] = box_of(soil);
    const double away = std::max(low.x() - s.x_to, s.x_from - high.x());
    if (away < reach.away) reach.away = away, reach.soil = soil.name;
    if (away < -tolerance) reach.touches = true;
    if (std::abs(away) > tolerance) continue;
    const double face = std::abs(s.x_to - low.x()) <= tolerance ? low.x() : high.x();
    const Polygon& p = soil.polygon;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Point &a = p[i], &b = p[(i + 1) % p.size()];
      const bool on_it = std::abs(a.x() - face) <= tolerance && std::abs(b.x() - face) <= tolerance;
      reach.touches |= on_it && std::min(a.y(), b.y()) < s.level;
    }
  }
  return reach;
}

void check_stretches(const Case& c, Issues& issues) {
  for (std::size_t i = 0; i < c.water.stretches.size(); ++i) {
    const WaterStretch& s = c.water.stretches[i];
    const Reach reach = reach_of(s, c);
    if (reach.touches) continue;
    const std::string why =
        reach.away > 1e-3 * c.particles.spacing
            ? fmt::format("it ends {:.4g} m beside soil '{}', the nearest", reach.away, reach.soil)
            : fmt::format("where it ends soil '{}' has no upright face below its level", reach.soil);
    issues.push_back({at("water.stretches", i), "touches no soil: " + why});
  }
}

void check_probes(const Case& c, Issues& issues) {
  for (std::size_t i = 0; i < c.probes.size(); ++i) {
    const auto is_in = [&](const SoilCase& soil) {
      return distance(c.probes[i].position, soil) <= 1e-6 * c.particles.spacing;
    };
    if (std::none_of(c.soils.begin(), c.soils.end(), is_in))
      issues.push_back(
          {at("probe", i, "position"),
           fmt::format("({}, {}) is outside all soils", c.probes[i].position.x(), c.probes[i].position.y())});
  }
}

/// Whether one boundary covers the segment from a to b. `slides`: along which the soil may slide.
bool is_covered(const Case& c, const Point& a, const Point& b, bool slides) {
  const double tolerance = 1e-3 * c.particles.spacing;
  return std::any_of(c.boundaries.begin(), c.boundaries.end(), [&](const BoundaryCase& boundary) {
    const auto reaches = [&](const Point& p) {
      return distance(p, p, boundary.from, boundary.to) < tolerance;
    };
    return slides != support_of(boundary.kind).carries_shear() && reaches(a) && reaches(b);
  });
}

bool is_upright_rectangle(const SoilCase& soil) {
  const Box box = box_of(soil);
  const double full = (box.high - box.low).prod();
  return std::abs(area(soil) - full) <= 1e-9 * full;
}

std::string bending_fault(const SoilCase& soil) {
  if (soil.bending_velocity == 0) return "";
  if (!is_upright_rectangle(soil)) return "needs a soil that is an upright rectangle";
  const Box box = box_of(soil);
  const Point size = box.high - box.low;
  return size.y() > size.x() ? "needs a soil that is at least as long as it is thick" : "";
}

std::string column_fault(const Case& c) {
  if (c.soils.size() != 1 || !c.soils[0].holes.empty()) return "needs one soil without holes";
  const auto [low, high] = box_of(c.soils[0]);
  if (!is_upright_rectangle(c.soils[0])) return "needs a soil that is an upright rectangle";
  if (!c.loading.gravity_applied) return "needs gravity";
  if (c.loading.horizontal != 0) return "needs gravity that is upright";
  if (c.water.flows()) return "needs water that stands still";
  if (c.water.present() && (c.water.stretches.size() > 1 || c.water.stretches[0].x_from > low.x() ||
                            c.water.stretches[0].x_to < high.x()))
    return "needs one water level over the whole soil";
  const Point left_top(low.x(), high.y()), right_bottom(high.x(), low.y());
  if (!is_covered(c, low, left_top, true) || !is_covered(c, right_bottom, high, true))
    return "needs rollers along both sides of the soil";
  if (!is_covered(c, low, right_bottom, true) && !is_covered(c, low, right_bottom, false))
    return "needs a boundary below the soil";
  return "";
}

}  // namespace

std::vector<CaseIssue> check_settings(const Case& c) {
  Issues issues;
  check_names(c.soils, "soil", issues);
  check_names(c.probes, "probe", issues);
  check_names(c.loads, "load", issues);
  check_names(c.sections, "section", issues);
  check_names(c.water.faces, "water.face", issues);
  check_names(c.water.drains, "water.drain", issues);
  check_names(c.footings, "footing", issues);
  check_names(c.sheets, "sheet", issues);
  const double end = latest_end(c);
  const double frames = c.output.interval > 0 ? end / c.output.interval : 0;
  if (frames > most_frames)
    issues.push_back(
        {"output.interval", fmt::format("makes {:.3g} frames; at most {:.0e}", frames, most_frames)});
  for (std::size_t i = 0; i < c.output.times.size(); ++i)
    if (c.output.times[i] > end)
      issues.push_back({at("output.times", i),
                        c.stages.empty() ? fmt::format("must be <= time.end = {} s", end)
                                         : fmt::format("must be <= {} s, when the last stage ends", end)});
  for (std::size_t i = 0; i < c.output.fields.size(); ++i)
    if (c.output.fields[i] == "ExcessStress" && c.reference == Reference::none)
      issues.push_back({at("output.fields", i), "is the excess over the exact solution: needs 'reference'"});
  if (!c.start_from.empty() && c.reference != Reference::none)
    issues.push_back(
        {"start_from", "cannot be combined with 'reference', which is for a case that starts by itself"});
  if (!c.start_from.empty() && c.water.flows_over_time())
    issues.push_back(
        {"start_from", fmt::format("cannot be combined with water.mode = \"{}\"", name(c.water.mode))});
  for (std::size_t i = 0; i < c.soils.size(); ++i)
    if (c.soils[i].law == LawKind::cam_clay && c.soils[i].cam_clay.preconsolidation == 0 &&
        !c.loading.k0_stress)
      issues.push_back({at("soil", i, "preconsolidation_pressure"),
                        "is missing: without loading.k0_stress = true there is no stress at the start that "
                        "overconsolidation_ratio could be over"});
  for (std::size_t i = 0; i < c.boundaries.size(); ++i) {
    if (c.boundaries[i].kind != BoundaryKind::friction) continue;
    if (c.formulation.motion != Motion::consistent)
      issues.push_back({at("boundary", i, "kind"), "\"friction\" needs formulation.motion = \"consistent\""});
    if (c.water.flows_over_time())
      issues.push_back(
          {at("boundary", i, "kind"),
           fmt::format("\"friction\" cannot be combined with water.mode = \"{}\"", name(c.water.mode))});
  }
  const Issues of_sides = check_sides_settings(c);
  issues.insert(issues.end(), of_sides.begin(), of_sides.end());
  const Issues of_flow = check_flow_settings(c);
  issues.insert(issues.end(), of_flow.begin(), of_flow.end());
  if (!c.check.finite_elements_auto && c.check.finite_elements)
    if (const std::string reason = fem_obstacle(c); !reason.empty())
      issues.push_back({"check.finite_elements", "they do not apply: " + reason});
  if (!c.loading.scaled_inertia_auto && c.loading.scaled_inertia)
    if (const std::string reason = inertia_obstacle(c); !reason.empty())
      issues.push_back({"loading.scaled_inertia", "is not possible: " + reason});
  return issues;
}

std::vector<CaseIssue> check_geometry(const Case& c) {
  Issues issues;
  check_outlines(c, issues);
  check_water(c, issues);
  if (!issues.empty()) return issues;
  check_size(c, issues);
  check_soils(c, issues);
  const bool soils_are_sound = issues.empty();
  for (std::size_t i = 0; i < c.soils.size(); ++i) {
    const std::string fault = bending_fault(c.soils[i]);
    if (!fault.empty()) issues.push_back({at("soil", i, "bending_velocity"), fault});
  }
  check_probes(c, issues);
  check_stretches(c, issues);
  if (!soils_are_sound) return issues;
  const Issues of_flow = check_faces(c);
  issues.insert(issues.end(), of_flow.begin(), of_flow.end());
  const Issues of_boundaries = check_boundaries(c);
  issues.insert(issues.end(), of_boundaries.begin(), of_boundaries.end());
  const Issues of_sides = check_periodic_sides(c);
  issues.insert(issues.end(), of_sides.begin(), of_sides.end());
  const Issues of_loads = check_loads(c);
  issues.insert(issues.end(), of_loads.begin(), of_loads.end());
  const Issues of_footings = check_footings(c);
  issues.insert(issues.end(), of_footings.begin(), of_footings.end());
  const Issues of_sheets = check_sheets(c);
  issues.insert(issues.end(), of_sheets.begin(), of_sheets.end());
  if (c.reference != Reference::none && of_boundaries.empty()) {
    const std::string fault = column_fault(c);
    if (!fault.empty()) issues.push_back({"reference", fault});
  }
  return issues;
}

}  // namespace porosph
