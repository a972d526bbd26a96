#include "solver/simulation/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace porosph {
namespace {

constexpr std::size_t block_size = 1024;  // sums over fixed blocks do not depend on the number of threads

struct Sums {
  double stiffness = 0, inertia = 0;
};

}  // namespace

void Relaxation::measure(const Particles& p, std::span<const Vec2> before, std::span<const Vec2> after,
                         double dt) {
  std::vector<Sums> blocks((p.size() + block_size - 1) / block_size);
#pragma omp parallel for schedule(static)
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    Sums sum;
    for (std::size_t i = block * block_size; i < std::min((block + 1) * block_size, p.size()); ++i) {
      sum.stiffness += p.mass[i] * p.velocity[i].dot(before[i] - after[i]) / dt;
      sum.inertia += p.mass[i] * p.velocity[i].squaredNorm();
    }
    blocks[block] = sum;
  }
  const double kept = std::exp(-0.5 * damping * steps_between * dt);  // the last 1 / omega counts
  stiffness *= kept, inertia *= kept;
  for (const Sums& sum : blocks) stiffness += sum.stiffness, inertia += sum.inertia;
  if (stiffness > 0 && inertia > 0) damping = std::min(2 * std::sqrt(stiffness / inertia), 1 / dt);
}

}  // namespace porosph
