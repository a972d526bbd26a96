#include "solver/run/base_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/boundary/traction.hpp"
#include "solver/space/parallel.hpp"

namespace porosph {

double base_acceleration(const ShakingCase& s, double time) {
  if (!s.acts()) return 0;
  if (!s.acceleration_over_time.empty()) return factor_at(s.acceleration_over_time, time);
  const double cycle = (time - s.start) * s.frequency;
  if (cycle <= 0 || cycle >= s.cycles) return 0;
  const double share = s.ramp > 0 ? std::min({1.0, cycle / s.ramp, (s.cycles - cycle) / s.ramp}) : 1;
  return share * s.amplitude * std::sin(2 * std::numbers::pi * cycle);
}

double end_of_shaking(const ShakingCase& s) {
  if (!s.acts()) return 0;
  if (!s.acceleration_over_time.empty()) return s.acceleration_over_time.back().x();
  return s.start + s.cycles / s.frequency;
}

void BaseMotion::push(double time, std::span<Vec2> accelerations) const {
  const double a = acceleration(time);
  if (a == 0) return;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < accelerations.size(); ++i) accelerations[i].x() -= a;
}

void BaseMotion::count_work(double time, const Particles& p, Kick kick, std::span<const Vec2> accelerations) {
  const double a = acceleration(time);
  if (a == 0) return;
  const double momentum = deterministic_sum(p.size(), [&](std::size_t i) {
    return p.mass[i] * (p.velocity[i].x() + kick(p.velocity[i], accelerations[i]).x()) / 2;
  });
  work_ -= kick.gain * a * momentum;
}

void BaseMotion::visit(StateArchive& state) { state.value("work_of_base", work_); }

}  // namespace porosph
