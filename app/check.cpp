// porosph check: validates a case and says what it will cost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/check_by_fem.hpp"
#include "app/command.hpp"
#include "app/memory.hpp"
#include "app/shipped_cases.hpp"
#include "app/stopwatch.hpp"
#include "app/summarise.hpp"
#include "app/threads.hpp"
#include "app/warnings.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/demand.hpp"
#include "solver/case/local_origin.hpp"
#include "solver/case/plausibility.hpp"
#include "solver/case/pores.hpp"
#include "solver/case/stages.hpp"
#include "solver/model/soil_volume.hpp"
#include "solver/run/run.hpp"
#include "solver/run/simulation.hpp"
#include "solver/water/flow/kozeny_carman.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;

constexpr double most_tried = 5e4, tried_instead = 1e4;  // particles: more take long to place and to step

/// Measured on the first steps of the case itself [s per step].
double seconds_per_step(Simulation& s) {
  use_threads(0, s.model().particles.size());
  s.advance();  // the first one searches neighbours
  const Stopwatch watch;
  int steps = 0;
  while (watch.seconds() < 0.5 && s.step() < s.last_step() && !s.instability()) s.advance(), ++steps;
  return steps > 0 ? watch.seconds() / steps : 0;
}

void print(std::string_view name, const std::string& text) { fmt::print("{:18}{}\n", name, text); }

void print_water(const Case& scene) {
  const bool transient = scene.water.mode == WaterMode::transient;
  if (transient || scene.water.mode == WaterMode::steady)
    return print(
        "water",
        fmt::format(
            "flows {} between {} faces{}", transient ? "over time" : "steadily", scene.water.faces.size(),
            scene.water.drains.empty() ? "" : fmt::format(" and {} drains", scene.water.drains.size())));
  if (!scene.water.present()) return print("water", "none");
  double whole = 0, wet = 0;
  for (const SoilCase& soil : scene.soils) {
    const SoilArea area = area_of(soil, scene.water);
    whole += area.whole, wet += area.wet;
  }
  print("water", fmt::format("{:.4g} of {:.4g} m2 of soil are below its level ({:.3g} %)", wet, whole,
                             100 * wet / whole));
}

void print_settings(const Case& scene) {
  print("spacing", fmt::format("{:g} m, smoothing length {:g} m, {}", scene.particles.spacing,
                               scene.smoothing_length(), arrangement_name(scene.particles.arrangement)));
  print("boundaries", fmt::format("{}", scene.boundaries.size()));
  print_water(scene);
  if (const Settlement s = settlement_by_own_weight(scene); s.compression > 0)
    print("own weight", fmt::format("lets soil '{}' settle by about {:.2g} % of its thickness",
                                    scene.soils[s.soil].name, 100 * s.compression));
  if (const Point origin = local_origin(scene); origin != Point::Zero())
    print("origin", fmt::format("({:.0f}, {:.0f}) m is what positions are computed from; results are in the "
                                "case's coordinates",
                                origin.x(), origin.y()));
  print("formulation", std::string(motion_name(scene.formulation.motion)));
}

std::string change_of_permeability(const SoilCase& soil) {
  if (soil.permeability_law == PermeabilityLaw::constant) return "";
  constexpr double one_percent = 0.01;
  const double porosity = porosity_of(soil), left = porosity_after(porosity, 1 - one_percent);
  if (!(left > 0)) return "; its permeability follows its pores, of which 1 % of compression leaves none";
  return fmt::format("; its permeability follows its pores: 1 % of compression takes {:.2g} % of it",
                     100 * (1 - kozeny_carman(porosity, left)));
}

/// c_v = k M / gamma_w, and how long a layer of each soil takes that drains on one side (Terzaghi).
void print_consolidation(const Simulation& s) {
  if (s.scene().water.mode == WaterMode::undrained)
    return print("consolidation", "none: the water stays where it is");
  constexpr double t50 = 0.19673, t90 = 0.84809;
  for (std::size_t i = 0; i < s.model().soils.size(); ++i) {
    const SoilCase& soil = s.scene().soils[i];
    const double coefficient =
        soil.permeability.y() * s.model().soils[i].constrained_modulus() / s.scene().water.unit_weight;
    const double path = typical_thickness(soil), unit = path * path / coefficient;
    print(i == 0 ? "consolidation" : "",
          fmt::format(
              "soil '{}': c_v = {:.4g} m2/s; half of it takes {:.3g} s and 90 % {:.3g} s where water goes "
              "{:.3g} m to one side{}",
              soil.name, coefficient, t50 * unit, t90 * unit, path, change_of_permeability(soil)));
  }
}

std::string softening_text(const StrengthCase& c, double spacing) {
  if (c.softening == SofteningKind::none) return "";
  return fmt::format(", softening: plastic strain counts {:.3g} times", spacing / c.softening_length);
}

/// "; mohr_coulomb, c = 5 kPa, phi = 30, psi = 0 degrees"
std::string strength_text(const SoilCase& soil, double spacing) {
  const StrengthCase& c = soil.strength;
  switch (soil.law) {
    case LawKind::elastic:
      return soil.no_tension ? "; no tension and no cohesion, shear strength unlimited in compression" : "";
    case LawKind::tresca:
      return fmt::format("; {}, c_u = {:.4g} kPa{}{}", law_name(soil.law), c.undrained_strength / 1e3,
                         c.growth > 0 ? fmt::format(" and {:.4g} kPa per m of depth", c.growth / 1e3) : "",
                         softening_text(c, spacing));
    case LawKind::cam_clay:
      return fmt::format(
          "; {}, M = {:g}, lambda = {:g}, kappa = {:g}, e = {:g}: K and G are the most that it may reach",
          law_name(soil.law), soil.cam_clay.ratio, soil.cam_clay.lambda, soil.cam_clay.kappa,
          soil.cam_clay.void_ratio);
    case LawKind::drucker_prager:
    case LawKind::mohr_coulomb:
    case LawKind::byrne:
      break;
  }
  return fmt::format(
      "; {}, c = {:.4g} kPa, phi = {:g}, psi = {:g} degrees{}{}", law_name(soil.law), c.cohesion / 1e3,
      c.friction_angle, c.dilation_angle,
      c.dilation_angle > 0 ? fmt::format(" up to a volume strain of {:g}", c.dilation_limit) : "",
      softening_text(c, spacing));
}

void print_model(const Simulation& s) {
  const Model& m = s.model();
  print("particles", fmt::format("{}", m.particles.size()));
  const std::vector<SoilVolume> volumes = soil_volumes(m, s.scene());
  for (std::size_t i = 0; i < m.soils.size(); ++i) {
    const SoilCase& soil = s.scene().soils[i];
    fmt::print("  {:16}{} of '{}' carry {:.5g} of its {:.5g} m2, K = {:.4g} MPa, G = {:.4g} MPa{}\n", "",
               volumes[i].particles, soil.name, volumes[i].carried, volumes[i].drawn,
               m.soils[i].bulk_modulus() / 1e6, m.soils[i].shear_modulus() / 1e6,
               strength_text(soil, m.spacing));
  }
  print_settings(s.scene());
  print("wave speed c_p", fmt::format("{:.4g} m/s", m.wave_speed));
  if (const auto inertia = scaled_inertia(s.scene()); !inertia.empty())
    print("inertia", inertia_text(inertia));
  if (s.consolidation() != nullptr) return print_consolidation(s);
  if (s.seepage() != nullptr) return;
  print("time step",
        fmt::format("{:.4g} s, {} steps to {:g} s", s.time_step(), s.last_step(), s.scene().time.end));
}

/// The same body with as many particles as are soon computed; fixed damping, which is by the step, as strong
/// in time. Its thin parts may hold none: throws std::runtime_error.
Case coarser(const Case& scene, double particles, double wanted) {
  Case coarse = scene;
  const double ratio = std::max(1.0, std::sqrt(particles / wanted));
  coarse.particles.spacing *= ratio;
  coarse.loading.damping = std::min(1.0, scene.loading.damping * ratio);
  return coarse;
}

/// When it comes to rest, by a run with few particles [s]; nothing where that does not, or takes too long.
std::optional<double> time_to_rest(const Case& scene, double particles) {
  constexpr double few = 600, longest = 2;  // s of computing
  if (scene.stop.unbalanced_force_ratio <= 0) return std::nullopt;
  try {
    Simulation simulation(coarser(scene, particles, few));
    const Stopwatch watch;
    const RunOutcome outcome =
        run(simulation, {.frame = {}, .history = {}, .progress = {}, .interrupted = [&] {
                           return watch.seconds() > longest;
                         }});
    if (outcome.status == RunStatus::equilibrium) return simulation.time();
  } catch (const std::runtime_error&) {
  }
  return std::nullopt;
}

void print_run_time(const Case& scene, double particles, double per_step, double steps,
                    std::string_view measured_on) {
  const double seconds = per_step * steps;
  if (scene.stop.unbalanced_force_ratio <= 0)
    return print("run time", fmt::format("about {:.2g} s (measured on {})", seconds, measured_on));
  if (const auto rest = time_to_rest(scene, particles))
    return print("run time",
                 fmt::format("until at rest, about {:.2g} s, at {:.2g} s of {:g} s (measured on {})",
                             seconds * *rest / scene.time.end, *rest, scene.time.end, measured_on));
  print("run time", fmt::format("at most {:.2g} s; it is not known when it comes to rest (measured on {})",
                                seconds, measured_on));
}

/// What each stage changes, how long it lasts, and how many particles it has. Nothing is computed.
void print_stages(const Case& scene, double seconds_per_particle_step) {
  StagePlan plan(scene);
  double seconds = 0;
  for (double start = 0;; start = plan.scene().time.end, plan.go_on(start)) {
    const Simulation s(plan.scene(), Beginning{.time = start});
    const auto particles = static_cast<double>(s.model().particles.size());
    const auto changes = plan.changes();
    print(plan.stage() == 0 ? "stages" : "",
          fmt::format("'{}': {}", plan.name(),
                      plan.stage() == 0 ? "the case as it begins"
                      : changes.empty() ? "nothing changes"
                                        : fmt::format("{}", fmt::join(changes, "; "))));
    print("", fmt::format("    {:g} s{}, {} particles, at most {} steps", s.scene().time.end - start,
                          s.scene().stop.unbalanced_force_ratio > 0 ? " or until at rest" : "", particles,
                          s.last_step()));
    seconds += seconds_per_particle_step * particles * static_cast<double>(s.last_step());
    if (plan.is_last()) break;
  }
  print("run time", fmt::format("at most {:.2g} s (measured on its first steps)", seconds));
}

void tell_tried(const Case& whole) {
  const Case scene = StagePlan(whole).scene();
  Simulation simulation(scene);
  warn(warnings_of(simulation.model(), scene));
  warn_of_smaller_steps(simulation);
  print_model(simulation);
  if (simulation.follows_flow()) return;
  const double per_step = seconds_per_step(simulation);
  if (!whole.stages.empty())
    return print_stages(whole, per_step / static_cast<double>(simulation.model().particles.size()));
  print_run_time(scene, static_cast<double>(simulation.model().particles.size()), per_step,
                 static_cast<double>(simulation.last_step()), "its first steps");
}

/// As a case of its own, arranged for itself.
Case first_stage(const Case& scene) {
  Case first = StagePlan(scene).scene();
  first.plan.reset();
  return first;
}

/// The same body with fewer particles tells how fast they go.
void tell_large(const Case& scene, const Demand& demand) {
  print("particles", fmt::format("about {:.3g}", demand.particles));
  print_settings(scene);
  if (scene.water.steps_by_flow()) return;
  print("time step", fmt::format("about {:.3g} s, {:.3g} steps to {:g} s", scene.time.end / demand.steps,
                                 demand.steps, scene.time.end));
  try {
    Simulation simulation(coarser(scene, demand.particles, tried_instead));
    const double per_particle_step =
        seconds_per_step(simulation) / static_cast<double>(simulation.model().particles.size());
    print_run_time(scene, demand.particles, per_particle_step * demand.particles, demand.steps,
                   "fewer particles");
  } catch (const std::runtime_error& error) {
    print("run time", fmt::format("not known: measured with fewer particles, {}", error.what()));
  }
}

}  // namespace

int check_command(const Arguments& arguments) {
  std::string case_file;
  std::vector<std::string> overrides;
  po::options_description options;
  options.add_options()("case", po::value(&case_file)->required(), "the case file")(
      "set", po::value(&overrides)->value_name("KEY=VALUE"),
      "replaces a setting of the case; may be given again");
  po::positional_options_description positional;
  positional.add("case", 1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "check CASE.toml [options]",
             "  porosph check cases/foundation.toml --set particles.spacing=0.1\n", values))
    return Exit::done;
  const Case scene = read_case(find_case(case_file), overrides);
  check_memory(scene);
  require_fem(scene);
  fmt::print("{} is valid: {}\n", case_file, scene.title);
  std::fflush(stdout);
  warn(warnings_of(scene));
  const Demand demand = demand_of(scene);
  print("memory", fmt::format("about {:.0f} MB", memory_needed(scene) / 1e6));
  print("finite elements", fem_outlook(scene));
  if (demand.particles > most_tried)
    tell_large(first_stage(scene), demand);
  else
    tell_tried(scene);
  return Exit::done;
}

}  // namespace porosph::app
