// What is said where a run is far from finite elements.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "solver/case/shapes.hpp"
#include "solver/reference/fem/compare.hpp"
#include "solver/reference/fem/rough_points.hpp"
#include "solver/space/place_text.hpp"
#include "solver/water/standing_water.hpp"

namespace porosph {
namespace {

/// Of a soil that are enough for its stress to be resolved.
constexpr double enough_rows = 4;
constexpr double noticeable_contrast = 2, noticeable_volume = 0.01, noticeable_strain = 0.02,
                 noticeable_misfit = 0.02;

bool touch(const SoilCase& a, const SoilCase& b, double dx) { return distance(a, b) < 1e-3 * dx; }

/// Area that the particles of a soil stand for over that of its outline, at t = 0.
double carried_area(const Case& scene, const Particles& p, int soil) {
  const SoilCase& s = scene.soils[soil];
  const StandingWater water(at_rest_from(scene.water, 0));
  double carried = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.soil[i] != soil) continue;
    const bool wet = water.depth(p.start[i].x(), p.start[i].y()) > 0;
    carried += scene.water.flows() ? p.volume(i)
                                   : p.mass[i] * scene.loading.gravity /
                                         (wet ? s.unit_weight_saturated : s.unit_weight_unsaturated);
  }
  return carried / area(s);
}

std::vector<std::string> of_the_formulation(const Case& scene) {
  const Motion motion = scene.formulation.motion;
  if (motion == Motion::conventional && scene.water.present())
    return {
        "the conventional form, eq. (17), is known to be wrong under water: the pore pressure acts as a "
        "suction on "
        "free surfaces"};
  if (motion == Motion::rho_squared && scene.soils.size() > 1)
    return {"eq. (25) is known to be wrong where soils of different weight meet"};
  return {};
}

std::vector<std::string> of_the_soil(const Case& scene, const Particles& p, int soil) {
  std::vector<std::string> causes;
  const double dx = scene.particles.spacing;
  const SoilCase& s = scene.soils[soil];
  if (const double rows = thickness(s.polygon) / dx; rows < enough_rows)
    causes.push_back(fmt::format("soil '{}' is only {:.2g} spacings thick", s.name, rows));
  for (const SoilCase& other : scene.soils) {
    if (&other == &s || !touch(s, other, dx)) continue;
    const double ratio = s.youngs_modulus / other.youngs_modulus, contrast = std::max(ratio, 1 / ratio);
    if (contrast >= noticeable_contrast)
      causes.push_back(fmt::format("soil '{}' beside it is {:.3g} times as {}", other.name, contrast,
                                   ratio > 1 ? "soft" : "stiff"));
  }
  for (int i = 0; i < static_cast<int>(scene.soils.size()); ++i) {
    const double carried = carried_area(scene, p, i);
    if (std::abs(carried - 1) > noticeable_volume)
      causes.push_back(
          fmt::format("the particles of soil '{}' carry {:.1f} % of its area (arrangement = \"fitted\" or "
                      "\"surface\" carries all of it)",
                      scene.soils[i].name, 100 * carried));
  }
  return causes;
}

/// A side of an outline that the cells of a lattice do not end on.
struct Misfit {
  char axis;     ///< 'x' or 'y', the coordinate that is the same all along it
  double line;   ///< that coordinate [m]
  double cells;  ///< how far the nearest border of cells is [m]
  double distance;
};

/// Sides that are not axis-parallel, which a lattice follows in steps.
bool is_inclined(const Point& a, const Point& b) { return a.x() != b.x() && a.y() != b.y(); }

using SideVisitor = std::function<void(const Point& from, const Point& to)>;

void for_sides(const Case& scene, const SideVisitor& visit) {
  const auto around = [&](const Polygon& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i) visit(outline[i], outline[(i + 1) % outline.size()]);
  };
  for (const SoilCase& soil : scene.soils) {
    around(soil.polygon);
    for (const Polygon& hole : soil.holes) around(hole);
  }
}

/// Of the sides along the axes that the lattice does not fit, the one nearest to x.
std::optional<Misfit> nearest_misfit(const Case& scene, const Point& x) {
  const double dx = scene.particles.spacing;
  Point low(never, never);
  for_sides(scene, [&](const Point& a, const Point&) { low = low.cwiseMin(a); });
  std::optional<Misfit> found;
  for_sides(scene, [&](const Point& a, const Point& b) {
    if (is_inclined(a, b)) return;
    const int k = a.x() == b.x() ? 0 : 1;
    const double off = std::abs(std::remainder(a[k] - low[k], dx)), away = distance(x, x, a, b);
    if (off > noticeable_misfit * dx && (!found || away < found->distance))
      found = Misfit{k == 0 ? 'x' : 'y', a[k], off, away};
  });
  return found;
}

std::vector<std::string> of_the_arrangement(const Case& scene, const Point& where) {
  if (scene.particles.arrangement == Arrangement::disordered) return {"the particles are disordered"};
  if (scene.particles.arrangement != Arrangement::lattice) return {};
  std::vector<std::string> causes;
  bool inclined = false;
  for_sides(scene, [&](const Point& a, const Point& b) { inclined = inclined || is_inclined(a, b); });
  if (inclined)
    causes.emplace_back(
        "the lattice follows inclined lines in steps (arrangement = \"fitted\" or \"surface\" does not)");
  if (const auto misfit = nearest_misfit(scene, where))
    causes.push_back(
        fmt::format("the lattice does not fit the line {} = {:.10g} m, {:.2g} m from the border of its cells "
                    "(arrangement = "
                    "\"fitted\" or \"surface\" does)",
                    misfit->axis, misfit->line, misfit->cells));
  return causes;
}

/// Whether particles see only one side there.
bool at_the_outline(const Case& scene, const Point& x) {
  const double reach = 2 * scene.smoothing_length();
  const MeshLines lines = mesh_lines(scene);
  return std::any_of(lines.lines.begin(), lines.lines.end(), [&](const MeshLine& line) {
    return line.outline() && distance(x, x, lines.points[line.from], lines.points[line.to]) < reach;
  });
}

/// What makes a corner a hard place.
std::string what_is_at(const RoughPoint& corner) {
  constexpr double bounded_below = std::numbers::pi / 3;  // of a toe on a fixed base: Williams 1952
  if (corner.kind == RoughPoint::interface_corner) return "where the border of the soils turns or branches";
  if (corner.angle > 0 && corner.angle < bounded_below)
    return fmt::format("where the soil ends in {:.0f} degrees, fewer and fewer spacings thick",
                       corner.angle * 180 / std::numbers::pi);
  if (corner.on_rollers && corner.angle > std::numbers::pi)
    return "where soil slides along both walls and stress grows without bound, more steeply than at a crack";
  return "where stress grows without bound";
}

std::vector<std::string> of_the_place(const Case& scene, const Point& x) {
  constexpr double near = 8;  // spacings
  const RoughPoint* nearest = nullptr;
  const std::vector<RoughPoint> points = rough_points(scene, mesh_lines(scene));
  for (const RoughPoint& p : points)
    if (p.kind != RoughPoint::weak && (!nearest || (p.at - x).norm() < (nearest->at - x).norm()))
      nearest = &p;
  if (!nearest || (nearest->at - x).norm() > near * scene.particles.spacing) return {};
  return {fmt::format("the corner at {} is near, {}", place_text(nearest->at), what_is_at(*nearest))};
}

std::vector<std::string> causes(const Case& scene, const Particles& p, const FemSoilCheck& check, int soil,
                                const Point& where) {
  std::vector<std::string> all = of_the_formulation(scene);
  const auto add = [&](const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  if (check.strain > noticeable_strain)
    add({fmt::format("its strain of {:.1f} % is more than finite elements of small strain are made for",
                     100 * check.strain)});
  add(of_the_soil(scene, p, soil));
  add(of_the_arrangement(scene, where));
  add(of_the_place(scene, where));
  if (at_the_outline(scene, where))
    add({fmt::format(
        "it is within the kernel's reach of the outline, and the section is resolved by spacings of {:g} m",
        scene.particles.spacing)});
  return all;
}

using NamedDifference = std::pair<const std::string, FemDifference>;

/// The component of a kind that is furthest off, nullptr if none is beyond the limit.
const NamedDifference* worst(const FemSoilCheck& soil, std::string_view kind, double FemDifference::*measure,
                             double limit) {
  const NamedDifference* found = nullptr;
  for (const auto& field : soil.fields)
    if (field.first.starts_with(kind) && !(field.second.*measure <= limit) &&
        (!found || !(field.second.*measure <= found->second.*measure)))
      found = &field;
  return found;
}

std::string joined(const std::vector<std::string>& why) {
  if (why.empty()) return "the cause is not known: compare with a smaller particles.spacing";
  return fmt::format("{}", fmt::join(why, "; "));
}

double to_millimetres(double x) { return std::round(1e3 * x) / 1e3; }

/// What is said of one kind of field of a soil, "" where it is within the limits.
std::string warning(const Case& scene, const Particles& p, const FemCheck& check, int s,
                    const FemSoilCheck& soil, std::string_view kind) {
  const std::string& of = scene.soils[s].name;
  const bool stress = kind == "EffectiveStress";
  if (const NamedDifference* field = worst(soil, kind, &FemDifference::relative, check.limit)) {
    const auto& [name, d] = *field;
    return fmt::format("{} of soil '{}' is {:.2g} % off finite elements, most at {}: {:.3g} {}; {}",
                       short_name(name), of, 100 * d.relative, place_text({d.x, d.y}),
                       d.max_abs / (stress ? 1e3 : 1e-3), stress ? "kPa" : "mm",
                       joined(causes(scene, p, soil, s, {d.x, d.y})));
  }
  if (const NamedDifference* field = worst(soil, kind, &FemDifference::local, check.local_limit)) {
    const auto& [name, d] = *field;
    return fmt::format(
        "{} of soil '{}' is {:.2g} % off finite elements around {}, and {:.2g} % in the "
        "whole soil; {}",
        short_name(name), of, 100 * d.local,
        place_text({to_millimetres(d.local_x), to_millimetres(d.local_y)}), 100 * d.relative,
        joined(causes(scene, p, soil, s, {d.local_x, d.local_y})));
  }
  return "";
}

}  // namespace

std::vector<std::string> fem_warnings(const Case& scene, const Particles& p, const FemCheck& check) {
  std::vector<std::string> warnings;
  for (int s = 0; s < static_cast<int>(scene.soils.size()); ++s) {
    const auto soil = check.soils.find(scene.soils[s].name);
    if (soil == check.soils.end()) continue;
    for (const std::string_view kind : {"EffectiveStress", "Displacement"})
      if (std::string text = warning(scene, p, check, s, soil->second, kind); !text.empty())
        warnings.push_back(std::move(text));
  }
  return warnings;
}

}  // namespace porosph
