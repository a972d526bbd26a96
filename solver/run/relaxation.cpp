#include "solver/run/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/space/parallel.hpp"

namespace porosph {
namespace {

struct Sums {
  double stiffness = 0, inertia = 0;

  Sums& operator+=(const Sums& o) {
    stiffness += o.stiffness, inertia += o.inertia;
    return *this;
  }
};

}  // namespace

void Relaxation::measure(const Particles& p, std::span<const Vec2> before, std::span<const Vec2> after,
                         double dt, std::optional<double> of_scaled) {
  Sums now = deterministic_sum<Sums>(p.size(), [&](std::size_t i) {
    return Sums{p.mass[i] * p.velocity[i].dot(before[i] - after[i]) / dt,
                p.mass[i] * p.velocity[i].squaredNorm()};
  });
  if (of_scaled) now.inertia = *of_scaled;
  const double kept = std::exp(-0.5 * damping * steps_between * dt);  // the last 1 / omega counts
  stiffness = stiffness * kept + now.stiffness, inertia = inertia * kept + now.inertia;
  if (stiffness > 0 && inertia > 0) damping = std::min(2 * std::sqrt(stiffness / inertia), 1 / dt);
}

void Relaxation::visit(StateArchive& state, std::string_view name) {
  state.value(fmt::format("{}_stiffness", name), stiffness);
  state.value(fmt::format("{}_inertia", name), inertia);
  state.value(fmt::format("{}_damping", name), damping);
}

}  // namespace porosph
