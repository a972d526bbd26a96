#include "solver/run/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/run/highest_frequency.hpp"

namespace porosph {
namespace {

/// omega h / c_p of a lattice, at its corners, for which Courant numbers are meant.
constexpr double lattice_frequency = 1.7;

/// The case's, or less where disorder, or stiff soil beside soil of less inertia, makes single particles
/// stiffer than they are in a lattice.
double courant_number(const Case& scene, const Model& model) {
  const ScaledInertia inertia(scene, model);
  if (scene.particles.arrangement != Arrangement::disordered && !inertia.acts()) return scene.time.courant;
  const double frequency =
      highest_frequency(scene.formulation, model, inertia) * model.smoothing_length / model.wave_speed;
  return scene.time.courant * std::min(1.0, lattice_frequency / frequency);
}

/// The case's, or else the largest that the Courant number allows, rounded down so that whole steps reach the
/// end time [s].
double time_step_of(const Case& scene, const Model& model, double courant, double start) {
  const double largest = courant * model.smoothing_length / model.wave_speed;
  const double given = scene.time.step;
  if (given > largest * (1 + 1e-12))
    throw std::runtime_error(fmt::format(
        "time.step = {:g} s: must be <= {:g} s, as the Courant number is {:g}", given, largest, courant));
  if (given > 0) return given;
  const double duration = scene.time.end - start;
  return duration / std::ceil(duration / largest * (1 - 1e-12));
}

}  // namespace

Clock make_clock(const Case& scene, const Model& model, double start) {
  Clock clock;
  clock.start = start;
  clock.courant = courant_number(scene, model);
  clock.dt = time_step_of(scene, model, clock.courant, start);
  clock.last_step = std::llround(std::ceil((scene.time.end - start) / clock.dt * (1 - 1e-12)));
  return clock;
}

void Clock::count_ticks_until(double end, double shortest) {
  constexpr double ticks_of_shortest = 64;
  constexpr std::int64_t fewest = std::int64_t{1} << 40, most = std::int64_t{1} << 53;  // exact as numbers
  last_step = fewest;
  while (last_step < most && end / static_cast<double>(last_step) > shortest / ticks_of_shortest)
    last_step *= 2;
  dt = end / static_cast<double>(last_step);
}

void Clock::reach(double time, std::int64_t due) {
  const std::int64_t nearest = std::llround((time - start) / dt);
  step = time < at(due) ? std::clamp<std::int64_t>(nearest, step + 1, due - 1) : due;
}

std::int64_t Clock::next_due(const OutputCase& output) const {
  std::int64_t due = last_step;
  const auto offer = [&](double time) {
    if (const std::int64_t tick = std::llround((time - start) / dt); tick > step) due = std::min(due, tick);
  };
  for (const double interval : {output.interval, output.history_interval})
    if (interval > 0) offer((std::floor(now() / interval + 1e-9) + 1) * interval);
  for (const double time : output.times) offer(time);
  return due;
}

}  // namespace porosph
