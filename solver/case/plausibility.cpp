#include "solver/case/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "solver/case/known_limits.hpp"
#include "solver/case/shapes.hpp"
#include "solver/geometry/clip.hpp"
#include "solver/geometry/moments.hpp"
#include "solver/geometry/region.hpp"
#include "solver/soil/elasticity.hpp"
#include "solver/water/standing_water.hpp"

namespace porosph {
namespace {

constexpr double tolerable_compression = 0.05, impossible_compression = 0.5, too_soft = 0.2;
constexpr int few_rows = 2;  // error of a layer between others: 59 % in u with one row, 3 % with two
constexpr int vertical_lines = 101;

struct Unit {
  double factor = 1;  // to SI
  std::string_view name;
};

/// The unit that a weight of soil or water looks like.
Unit unit_of_weight(double weight) {
  if (weight >= 1 && weight <= 40) return {1e3, "kN/m3"};
  if (weight >= 900 && weight <= 4000) return {9.81, "kg/m3"};
  return {1, "N/m3"};
}

double likely(double weight) { return weight * unit_of_weight(weight).factor; }

/// The unit in which Young's modulus would carry the soil.
Unit unit_of_modulus(double modulus, double compression) {
  for (const Unit& unit : {Unit{1e3, "kPa"}, Unit{1e6, "MPa"}, Unit{1e9, "GPa"}})
    if (compression / unit.factor < tolerable_compression && modulus * unit.factor >= 1e5) return unit;
  return {1, "Pa"};
}

/// A stretch of soil on a vertical line [m].
struct Interval {
  double low = 0, high = 0;
  std::size_t soil = 0;
};

void add_crossings(const Polygon& outline, double x, std::vector<double>& heights) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.x() <= x) != (b.x() <= x))
      heights.push_back(a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
  }
}

/// The soils on the line through x, from the top.
std::vector<Interval> soils_along(const Case& scene, double x) {
  std::vector<Interval> intervals;
  for (std::size_t soil = 0; soil < scene.soils.size(); ++soil) {
    std::vector<double> heights;
    add_crossings(scene.soils[soil].polygon, x, heights);
    for (const Polygon& hole : scene.soils[soil].holes) add_crossings(hole, x, heights);
    std::ranges::sort(heights);
    for (std::size_t i = 0; i + 1 < heights.size(); i += 2)
      intervals.push_back({heights[i], heights[i + 1], soil});
  }
  std::ranges::sort(intervals, std::greater<>{}, &Interval::high);
  return intervals;
}

double constrained_modulus(const SoilCase& soil) {
  return Elasticity::from_young(soil.youngs_modulus, soil.poissons_ratio).constrained_modulus();
}

/// Settlement of one interval under `above` [Pa], which grows by the interval's effective weight [m].
double settle(const Interval& interval, const Case& scene, double level, double& above) {
  const SoilCase& soil = scene.soils[interval.soil];
  const double wet = std::clamp(level - interval.low, 0.0, interval.high - interval.low);
  const double buoyant = likely(soil.unit_weight_saturated) - likely(scene.water.unit_weight);
  double settlement = 0;
  for (const auto& [thickness, weight] :
       {std::pair{interval.high - interval.low - wet, likely(soil.unit_weight_unsaturated)},
        std::pair{wet, buoyant}}) {
    settlement += thickness * (above + thickness * weight / 2) / constrained_modulus(soil);
    above += thickness * weight;
  }
  return settlement;
}

std::string key(std::size_t soil, std::string_view name) { return fmt::format("soil[{}].{}", soil, name); }

/// 15e6 rather than 15000000, 0.2 rather than 0.19999.
std::string number(double x) {
  const double exponent = x >= 1e4 ? 3 * std::floor(std::log10(x) / 3) : 0;
  const std::string digits = fmt::format("{:.4g}", x / std::pow(10, exponent));
  return exponent > 0 ? fmt::format("{}e{:.0f}", digits, exponent) : digits;
}

void check_weight(const std::string& key, double weight, std::vector<std::string>& out) {
  const Unit unit = unit_of_weight(weight);
  if (unit.factor == 1) return;
  out.push_back(fmt::format("{} = {:g} N/m3 looks like a value in {}: {:g} {} is {} N/m3", key, weight,
                            unit.name, weight, unit.name, number(likely(weight))));
}

void check_weights(const Case& scene, std::vector<std::string>& out) {
  for (std::size_t i = 0; i < scene.soils.size(); ++i) {
    const SoilCase& soil = scene.soils[i];
    check_weight(key(i, "unit_weight_saturated"), soil.unit_weight_saturated, out);
    if (soil.unit_weight_unsaturated != soil.unit_weight_saturated)
      check_weight(key(i, "unit_weight_unsaturated"), soil.unit_weight_unsaturated, out);
  }
  if (!scene.water.present()) return;
  check_weight("water.unit_weight", scene.water.unit_weight, out);
  for (std::size_t i = 0; i < scene.soils.size(); ++i) {
    const SoilCase& soil = scene.soils[i];
    if (likely(soil.unit_weight_saturated) > likely(scene.water.unit_weight)) continue;
    if (area_of(soil, scene.water).wet > 0)
      out.push_back(fmt::format("{} = {:g} N/m3 is not above water's {:g} N/m3: soil '{}' floats below water",
                                key(i, "unit_weight_saturated"), soil.unit_weight_saturated,
                                scene.water.unit_weight, soil.name));
  }
}

std::string percent(double ratio) { return fmt::format("{:.{}f} %", 100 * ratio, ratio < 0.1 ? 1 : 0); }

/// "youngs_modulus = ... lets ... settle by ...", and the unit that may have been meant.
std::string compression_text(const Case& scene, const Settlement& settlement) {
  const SoilCase& soil = scene.soils[settlement.soil];
  std::string text =
      fmt::format("{} = {:g} Pa lets soil '{}' settle by about {} of its thickness under its own weight",
                  key(settlement.soil, "youngs_modulus"), soil.youngs_modulus, soil.name,
                  percent(settlement.compression));
  if (settlement.compression < impossible_compression) return text;
  const Unit unit = unit_of_modulus(soil.youngs_modulus, settlement.compression);
  if (unit.factor > 1)
    text += fmt::format(": it looks like a value in {}: {:g} {} is {} Pa", unit.name, soil.youngs_modulus,
                        unit.name, number(soil.youngs_modulus * unit.factor));
  return text;
}

void check_settlement(const Case& scene, std::vector<std::string>& out) {
  const Settlement settlement = settlement_by_own_weight(scene);
  if (settlement.compression > tolerable_compression) out.push_back(compression_text(scene, settlement));
}

void check_rows(const Case& scene, std::vector<std::string>& out) {
  const double spacing = scene.particles.spacing;
  for (std::size_t i = 0; i < scene.soils.size(); ++i) {
    const double thickness = typical_thickness(scene.soils[i]);
    const auto rows = std::max(1L, std::lround(thickness / spacing));
    if (rows > few_rows) continue;
    out.push_back(fmt::format(
        "soil[{}].polygon: soil '{}' is {:.3g} m thick, {} of particles with "
        "particles.spacing = {:g} m: too few for its stress and strain; three rows need {:.2g} m",
        i, scene.soils[i].name, thickness, rows == 1 ? "one row" : "two rows", spacing, thickness / 3));
  }
}

/// Of a strength that bears next to nothing: it may be in kPa.
void check_strength_unit(const Case& scene, std::size_t i, std::string_view name, double value,
                         std::vector<std::string>& out) {
  const SoilCase& soil = scene.soils[i];
  const double weight = likely(soil.unit_weight_saturated) * thickness(soil.polygon);
  if (value < 1 || value > 1e-3 * weight) return;
  out.push_back(
      fmt::format("{} = {:g} Pa is {:.1g} of the soil's weight per area: it looks like a value in "
                  "kPa: {:g} kPa is {} Pa",
                  key(i, name), value, value / weight, value, number(value * 1e3)));
}

/// K0 stress on a level ground that the soil cannot bear: Rankine's limits, and Tresca's.
void check_k0_strength(const Case& scene, std::size_t i, std::vector<std::string>& out) {
  const SoilCase& soil = scene.soils[i];
  const StrengthCase& c = soil.strength;
  if (!scene.loading.k0_stress || soil.law == LawKind::tresca || c.cohesion > 0) return;
  const double nu = soil.poissons_ratio, k0 = scene.loading.k0 >= 0 ? scene.loading.k0 : nu / (1 - nu);
  const double sine = std::sin(c.friction_angle * std::numbers::pi / 180);
  const double active = (1 - sine) / (1 + sine);
  if (k0 >= active * (1 - 1e-9) && k0 <= (1 + 1e-9) / active) return;
  out.push_back(
      fmt::format("{} = {:g} degrees bears K0 from {:.3g} to {:.3g}, but K0 is {:.3g}: the soil "
                  "yields in the first step",
                  key(i, "friction_angle"), c.friction_angle, active, 1 / active, k0));
}

void check_strength(const Case& scene, std::vector<std::string>& out) {
  for (std::size_t i = 0; i < scene.soils.size(); ++i) {
    const SoilCase& soil = scene.soils[i];
    const StrengthCase& c = soil.strength;
    if (soil.law == LawKind::elastic || soil.law == LawKind::cam_clay) continue;
    if (scene.loading.gravity_applied) {
      if (soil.law == LawKind::tresca)
        check_strength_unit(scene, i, "undrained_strength", c.undrained_strength, out);
      else
        check_strength_unit(scene, i, "cohesion", c.cohesion, out);
      check_k0_strength(scene, i, out);
    }
    if (c.softening != SofteningKind::none && scene.particles.spacing > c.softening_length)
      out.push_back(
          fmt::format("{} = {:g} m is less than particles.spacing = {:g} m: no shear band is as "
                      "narrow as that",
                      key(i, "softening_length"), c.softening_length, scene.particles.spacing));
  }
}

double circumference(const SoilCase& soil) {
  double sum = 0;
  const auto add = [&](const Polygon& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) sum += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  };
  add(soil.polygon);
  for (const Polygon& hole : soil.holes) add(hole);
  return sum;
}

/// Cells that a slope cuts break down at 0.9 in a layered embankment of this contrast, and not at 0.8.
constexpr double large_contrast = 1000, safe_courant = 0.8;

/// Of the stiffest soil over the softest.
double stiffness_contrast(const Case& scene) {
  double least = never, most = 0;
  for (const SoilCase& soil : scene.soils)
    least = std::min(least, soil.youngs_modulus), most = std::max(most, soil.youngs_modulus);
  return most / least;
}

}  // namespace

std::vector<std::string> doubtful_values(const Case& scene) {
  std::vector<std::string> warnings;
  if (scene.loading.gravity_applied) {
    check_weights(scene, warnings);
    check_settlement(scene, warnings);
  }
  check_strength(scene, warnings);
  check_rows(scene, warnings);
  return warnings;
}

Settlement settlement_by_own_weight(const Case& scene) {
  Settlement worst;
  if (!scene.loading.gravity_applied) return worst;
  double left = never, right = -never;
  for (const SoilCase& soil : scene.soils)
    for (const Point& p : soil.polygon) left = std::min(left, p.x()), right = std::max(right, p.x());
  const StandingWater water(scene.water);
  for (int k = 0; k < vertical_lines; ++k) {
    const double x = left + (right - left) * (k + 0.5) / vertical_lines;
    const double level = water.depth(x, 0);
    double above = 0;
    for (const Interval& interval : soils_along(scene, x)) {
      const double thickness = interval.high - interval.low;
      const double compression = settle(interval, scene, level, above) / thickness;
      if (compression > worst.compression) worst = {interval.soil, compression};
    }
  }
  return worst;
}

std::string usual_cause_of_breakdown(const Case& scene) {
  if (const Settlement s = settlement_by_own_weight(scene); s.compression > too_soft)
    return "the usual cause is soil too soft for its weight: " + compression_text(scene, s);
  if (const auto failures = known_failures(scene); !failures.empty())
    return "the usual cause is known: " + failures.front();
  if (const double contrast = stiffness_contrast(scene);
      contrast >= large_contrast && scene.time.courant > safe_courant)
    return fmt::format(
        "the usual cause is a time step too long where soils meet of which one is {:.3g} times as stiff as "
        "the "
        "other: take time.courant = {:g} in place of {:g}",
        contrast, safe_courant, scene.time.courant);
  return fmt::format(
      "the usual cause is a load or a motion too large for the soil's stiffness "
      "(youngs_modulus); time.courant = {:g} by itself is known to be stable",
      scene.time.courant);
}

SoilArea area_of(const SoilCase& soil, const WaterCase& water) {
  const Region region(soil.polygon, soil.holes);
  SoilArea area{.whole = region.area()};
  for (const WaterStretch& s : water.stretches) {
    std::vector<Polygon> rings = region.rings();
    clip(rings, {Point(0, 1), s.level});
    if (s.x_from > -never) clip(rings, {Point(-1, 0), -s.x_from});
    if (s.x_to < never) clip(rings, {Point(1, 0), s.x_to});
    area.wet += moments(rings, region.lower_left()).area;
  }
  return area;
}

double typical_thickness(const SoilCase& soil) {
  const double half = circumference(soil) / 2, whole = area(soil);
  const double root =
      half * half - 4 * whole;  // w + l = half, w l = whole; negative where rounder than a square
  const double strip = (half - std::sqrt(std::max(0.0, root))) / 2;
  return std::min(thickness(soil.polygon), strip);
}

}  // namespace porosph
