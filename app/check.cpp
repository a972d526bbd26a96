// porosph check: validates a case and says what it will cost.
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "app/check_by_fem.hpp"
#include "app/command.hpp"
#include "app/memory.hpp"
#include "app/shipped_cases.hpp"
#include "app/threads.hpp"
#include "app/warnings.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/demand.hpp"
#include "solver/simulation/simulation.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;

constexpr double most_tried = 5e4, tried_instead = 1e4;  // particles: more take long to place and to step

/// Measured on the first steps of the case itself [s per step].
double seconds_per_step(Simulation& s) {
  using Clock = std::chrono::steady_clock;
  use_threads(0, s.model().particles.size());
  s.advance();  // the first one searches neighbours
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  int steps = 0;
  while (elapsed() < 0.5 && s.step() < s.last_step() && !s.instability()) s.advance(), ++steps;
  return steps > 0 ? elapsed() / steps : 0;
}

void print_settings(const Case& scene) {
  fmt::print("{:18}{:g} m, smoothing length {:g} m\n", "spacing", scene.particles.spacing,
             scene.smoothing_length());
  fmt::print("{:18}{}\n", "boundaries", scene.boundaries.size());
  fmt::print("{:18}{}\n", "formulation", motion_name(scene.formulation.motion));
}

void print_model(const Simulation& s) {
  const Model& m = s.model();
  fmt::print("{:18}{}\n", "particles", m.particles.size());
  for (std::size_t i = 0; i < m.soils.size(); ++i) {
    const auto count =
        std::count(m.particles.soil.begin(), m.particles.soil.end(), static_cast<std::int32_t>(i));
    fmt::print("  {:16}{} of '{}', K = {:.4g} MPa, G = {:.4g} MPa\n", "", count, s.scene().soils[i].name,
               m.soils[i].bulk_modulus() / 1e6, m.soils[i].shear_modulus() / 1e6);
  }
  print_settings(s.scene());
  fmt::print("{:18}{:.4g} m/s\n", "wave speed c_p", m.wave_speed);
  fmt::print("{:18}{:.4g} s, {} steps to {:g} s\n", "time step", s.time_step(), s.last_step(),
             s.scene().time.end);
}

void print_run_time(double seconds, std::string_view measured_on) {
  fmt::print("{:18}about {:.3g} s, if it runs to the end (measured on {})\n", "run time", seconds,
             measured_on);
}

void tell_tried(const Case& scene) {
  Simulation simulation(scene);
  warn_of_smaller_steps(simulation);
  print_model(simulation);
  print_run_time(seconds_per_step(simulation) * static_cast<double>(simulation.last_step()),
                 "its first steps");
}

/// The same body with fewer particles tells how fast they go; its thin parts may not hold any.
void tell_large(const Case& scene, const Demand& demand) {
  fmt::print("{:18}about {:.3g}\n", "particles", demand.particles);
  print_settings(scene);
  fmt::print("{:18}about {:.3g} s, {:.3g} steps to {:g} s\n", "time step", scene.time.end / demand.steps,
             demand.steps, scene.time.end);
  Case coarse = scene;
  coarse.particles.spacing *= std::sqrt(demand.particles / tried_instead);
  try {
    Simulation simulation(coarse);
    const double per_particle_step =
        seconds_per_step(simulation) / static_cast<double>(simulation.model().particles.size());
    print_run_time(per_particle_step * demand.particles * demand.steps, "fewer particles");
  } catch (const std::runtime_error& error) {
    fmt::print("{:18}not known: measured with fewer particles, {}\n", "run time", error.what());
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
  warn_of_known_failures(scene);
  const Demand demand = demand_of(scene);
  fmt::print("{:18}about {:.0f} MB\n", "memory", demand.bytes / 1e6);
  fmt::print("{:18}{}\n", "finite elements", fem_outlook(scene));
  if (demand.particles > most_tried)
    tell_large(scene, demand);
  else
    tell_tried(scene);
  return Exit::done;
}

}  // namespace porosph::app
