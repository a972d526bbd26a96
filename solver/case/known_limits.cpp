#include "solver/case/known_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/case/case_file.hpp"
#include "solver/case/check_loads.hpp"

namespace porosph {
namespace {

// Each number with the sweep in cases/stability that it was read from. tests/stability/known_limits_test.cpp
// computes those sweeps on both sides of it.
constexpr double largest_courant =
    1.0;  // courant_control: 1.1 fails with the default control, as 1.2 does with any
constexpr double largest_courant_paper = 1.1;  // courant_formulation
constexpr double largest_control_times_courant =
    0.36;  // courant_control: 0.4 at 0.9 holds, 0.5 at 0.9 and 0.4 at 1 do not
constexpr double least_density_ratio = 0.6;  // density_ratio: eq. (14) breaks down at 0.55 and below
constexpr double least_viscosity = 0.1;  // viscosity_undamped: 0.03 gains energy after 100 s, 0 after 30 s
constexpr double long_undamped = 25;     // periods of the slowest vibration
// unit_solver [footing]: Prandtl's load comes out to 1.5 % between them. At 1.4 up to 3 % are missing once
// the plate is at rest, at 1.1 up to 14 %, at 1 a third and more.
constexpr double least_smoothing_at_footings = 1.15, most_smoothing_at_footings = 1.3;
constexpr double tolerable_disorder =
    0.01;  // disorder: 0.05 makes an error of 9 to 21 % where gradients are not closed

void check_time_step(const Case& c, std::vector<std::string>& out) {
  const bool consistent = c.formulation.motion == Motion::consistent;
  const double limit = consistent ? largest_courant : largest_courant_paper;
  if (c.time.courant > limit)
    out.push_back(fmt::format("time.courant = {:g}: runs break down above {:g}", c.time.courant, limit));
  const double control = c.formulation.zero_energy_control;
  if (consistent && c.time.courant <= limit &&
      control * c.time.courant > largest_control_times_courant * (1 + 1e-9))
    out.push_back(
        fmt::format("formulation.zero_energy_control = {:g} with time.courant = {:g}: runs break down "
                    "where their product is above {:g}",
                    control, c.time.courant, largest_control_times_courant));
}

void check_water(const Case& c, std::vector<std::string>& out) {
  if (c.formulation.motion != Motion::conventional || !c.water.present()) return;
  double ground = -never, level = -never;
  bool no_tension = false;
  for (const SoilCase& soil : c.soils) {
    no_tension |= soil.no_tension;
    for (const Point& p : soil.polygon) ground = std::max(ground, p.y());
  }
  for (const WaterStretch& s : c.water.stretches) level = std::max(level, s.level);
  if (level <= ground) return;
  out.push_back(
      fmt::format("formulation.motion = \"conventional\" with water {:.3g} m above the ground: the pore "
                  "pressure there acts as a "
                  "suction of {:.3g} kPa, {}; \"proposed\" and \"consistent\" have none",
                  level - ground, c.water.unit_weight * (level - ground) / 1e3,
                  no_tension ? "which throws off soil without tension" : "by which the stress is wrong"));
}

void check_density_ratio(const Case& c, std::vector<std::string>& out) {
  if (c.formulation.motion != Motion::rho_squared) return;
  double lightest = never, heaviest_soil = 0;
  for (const SoilCase& s : c.soils) {
    lightest = std::min(lightest, s.unit_weight_unsaturated);
    heaviest_soil = std::max(heaviest_soil, s.unit_weight_saturated);
  }
  if (lightest < least_density_ratio * heaviest_soil)
    out.push_back(
        fmt::format("formulation.motion = \"rho_squared\" with soils of a density ratio of {:.2g}: it fails "
                    "below {:g}; \"proposed\" and \"consistent\" do not",
                    lightest / heaviest_soil, least_density_ratio));
}

void check_undamped(const Case& c, std::vector<std::string>& out) {
  const FormulationCase& f = c.formulation;
  const double undamped = c.loading.damping > 0 ? c.time.end - c.loading.damping_until : c.time.end;
  double height = 0, slowest = never;
  for (const SoilCase& s : c.soils) {
    const auto [low, high] = std::minmax_element(
        s.polygon.begin(), s.polygon.end(), [](const Point& a, const Point& b) { return a.y() < b.y(); });
    const double nu = s.poissons_ratio;
    const double modulus = s.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    height += high->y() - low->y();
    slowest = std::min(slowest, std::sqrt(modulus * c.loading.gravity / s.unit_weight_saturated));
  }
  if (f.motion == Motion::consistent || f.artificial_viscosity_alpha >= least_viscosity) return;
  if (undamped > long_undamped * 4 * height / slowest)
    out.push_back(
        fmt::format("{:.3g} s without damping and formulation.artificial_viscosity_alpha = {:g}: the paper's "
                    "forms gain energy below {:g}",
                    undamped, f.artificial_viscosity_alpha, least_viscosity));
}

void check_disorder(const Case& c, std::vector<std::string>& out) {
  const FormulationCase& f = c.formulation;
  const bool closed = f.motion == Motion::consistent && f.kernel_correction && f.closed_gradients;
  if (c.particles.arrangement != Arrangement::disordered || c.particles.disorder <= tolerable_disorder ||
      closed)
    return;
  out.push_back(
      fmt::format("particles.disorder = {:g}: the stress of single particles is wrong, by about 10 % at 0.05 "
                  "and more beyond; it is not with "
                  "formulation.motion = \"consistent\" and closed_gradients",
                  c.particles.disorder));
}

void check_flow(const Case& c, std::vector<std::string>& out) {
  if (c.formulation.motion == Motion::consistent) return;
  for (const SoilCase& soil : c.soils) {
    if (soil.law == LawKind::elastic) continue;
    out.push_back(fmt::format(
        "formulation.motion = \"{}\" with soil '{}' of law \"{}\": where it flows, the runout depends on "
        "artificial_viscosity_alpha and the density collapses in time; \"consistent\" knows neither",
        motion_name(c.formulation.motion), soil.name, law_name(soil.law)));
    return;
  }
}

/// failure_dilation_limit: 0.7 completes, 1 breaks down.
void check_dilation(const Case& c, std::vector<std::string>& out) {
  constexpr double most = 0.5;
  const bool damped = c.loading.adaptive_damping || c.loading.damping > 0;
  if (c.formulation.motion != Motion::consistent || damped || !c.loading.gravity_applied) return;
  for (const SoilCase& soil : c.soils) {
    const bool may = has_friction(soil.law);
    const StrengthCase& s = soil.strength;
    if (!may || s.dilation_angle == 0 || s.softening != SofteningKind::none || s.dilation_limit <= most)
      continue;
    out.push_back(fmt::format(
        "soil '{}' with dilation_limit = {:g}, without damping: where it flows its particles grow to {:.2g} "
        "times their volume, and the run may break down; dense soil is at its largest void ratio at 0.1 or "
        "so",
        soil.name, s.dilation_limit, std::exp(s.dilation_limit)));
    return;
  }
}

/// Soil flows around the edge of a plate, where it needs neighbours enough.
void check_footings(const Case& c, std::vector<std::string>& out) {
  const double ratio = c.particles.smoothing_ratio;
  if (!footing_on_soil_that_may_yield(c) ||
      (ratio >= least_smoothing_at_footings && ratio <= most_smoothing_at_footings))
    return;
  out.push_back(fmt::format(
      "particles.smoothing_ratio = {:g} under footing '{}' on soil that yields: its load falls off once it "
      "settles no more, by 3 % and more of what soil bears; 1.2 has the bearing capacity to 1.5 %",
      ratio, c.footings.front().name));
}

}  // namespace

std::vector<std::string> known_failures(const Case& scene) {
  std::vector<std::string> warnings;
  check_time_step(scene, warnings);
  check_water(scene, warnings);
  check_density_ratio(scene, warnings);
  check_undamped(scene, warnings);
  check_disorder(scene, warnings);
  check_flow(scene, warnings);
  check_dilation(scene, warnings);
  check_footings(scene, warnings);
  return warnings;
}

}  // namespace porosph
