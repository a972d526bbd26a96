// porosph check: validates a case and says what it will cost.
#include <fmt/format.h>

#include <chrono>
#include <iostream>

#include "app/command.hpp"
#include "app/shipped_cases.hpp"
#include "solver/case/case_file.hpp"
#include "solver/simulation/simulation.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;

/// Measured on the first steps of the case itself [s per step].
double seconds_per_step(Simulation& s) {
  using Clock = std::chrono::steady_clock;
  s.advance();  // the first one searches neighbours
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  int steps = 0;
  while (elapsed() < 0.5 && s.step() < s.last_step() && !s.instability()) s.advance(), ++steps;
  return steps > 0 ? elapsed() / steps : 0;
}

void print_model(const Simulation& s) {
  const Model& m = s.model();
  fmt::print("{:18}{}\n", "particles", m.particles.size());
  for (std::size_t i = 0; i < m.soils.size(); ++i) {
    const auto count =
        std::count(m.particles.soil.begin(), m.particles.soil.end(), static_cast<std::int32_t>(i));
    fmt::print("  {:16}{} of '{}', K = {:.4g} MPa, G = {:.4g} MPa\n", "", count, s.scene().soils[i].name,
               m.soils[i].bulk_modulus / 1e6, m.soils[i].shear_modulus / 1e6);
  }
  fmt::print("{:18}{:g} m, smoothing length {:g} m\n", "spacing", m.spacing, m.smoothing_length);
  fmt::print("{:18}{}\n", "walls", m.walls.size());
  fmt::print("{:18}{}\n", "formulation", motion_name(s.scene().formulation.motion));
  fmt::print("{:18}{:.4g} m/s\n", "wave speed c_p", m.wave_speed);
  fmt::print("{:18}{:.4g} s, {} steps to {:g} s\n", "time step", s.time_step(), s.last_step(),
             s.scene().time.end);
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
  Simulation simulation(read_case(find_case(case_file), overrides));
  fmt::print("{} is valid: {}\n", case_file, simulation.scene().title);
  print_model(simulation);
  const double particles = static_cast<double>(simulation.model().particles.size());
  fmt::print("{:18}about {:.0f} MB\n", "memory", particles * 1.2e3 / 1e6 + 10);
  const double per_step = seconds_per_step(simulation);
  fmt::print("{:18}about {:.3g} s, if it runs to the end (measured on its first steps)\n", "run time",
             per_step * static_cast<double>(simulation.last_step()));
  return Exit::done;
}

}  // namespace porosph::app
