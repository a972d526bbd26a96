#include "solver/run/settling.hpp"

#include <algorithm>
#include <cmath>

#include "solver/run/relaxed_step.hpp"

namespace porosph {
namespace {

constexpr double most_crossings = 200;
constexpr int steps_between_balances = 10;

bool is_sound(const Particles& p, double fastest) {
  return std::ranges::all_of(p.velocity,
                             [&](const Vec2& v) { return v.squaredNorm() < fastest * fastest; }) &&
         std::ranges::all_of(p.density, [](double rho) { return rho > 0; });
}

}  // namespace

bool Settling::settle(Model& model, Dynamics& dynamics, const Task& task) {
  Particles& p = model.particles;
  const double crossing = extent_of(p) / model.wave_speed;
  const auto most = static_cast<std::int64_t>(std::ceil(most_crossings * crossing / dt));
  std::ranges::fill(p.velocity, Vec2::Zero());
  std::vector<Vec2> before;
  double in_balance = 0;
  for (std::int64_t k = 0; k < most; ++k, ++sweeps) {
    const auto forces = task.forces();
    if (!before.empty()) relaxation.measure(p, before, forces, dt);
    before.clear();
    if (k % steps_between_balances == 0) {
      if (!is_sound(p, model.wave_speed)) return false;
      in_balance = task.ratio() < task.enough ? in_balance + steps_between_balances * dt : 0;
      const double needed =
          relaxation.damping > 0 ? std::min(2 * crossing, 4 / relaxation.damping) : 2 * crossing;
      if (in_balance > needed) {
        std::ranges::fill(p.velocity, Vec2::Zero());
        dynamics.strain(0);  // it remembers velocities
        return true;
      }
    }
    if (k % Relaxation::steps_between == 0) before.assign(forces.begin(), forces.end());
    relaxed_step(model, dynamics, full_kick(relaxation.damping, dt), dt, forces);
  }
  return false;
}

void Settling::visit(StateArchive& state) {
  state.value("settling_sweeps", sweeps);
  relaxation.visit(state, "settling");
}

}  // namespace porosph
