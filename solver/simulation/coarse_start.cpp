#include "solver/simulation/coarse_start.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "solver/neighbours/neighbour_list.hpp"
#include "solver/simulation/probe.hpp"
#include "solver/simulation/run.hpp"

namespace porosph {
namespace {

constexpr double coarse_balance = 1e-3;  // unbalanced force ratio: far below the coarse run's own error
constexpr int steps = 5;                 // in which the displacement is applied: strains of each are small

Case coarser(const Case& scene) {
  Case coarse = scene;
  coarse.particles.spacing *= 2;
  --coarse.loading.coarse_starts;
  coarse.stop.unbalanced_force_ratio = std::max(coarse.stop.unbalanced_force_ratio, coarse_balance);
  coarse.probes.clear();
  coarse.reference = Reference::none;
  coarse.output.history_interval = coarse.time.end;
  return coarse;
}

std::vector<Vec2> displacements_at(const std::vector<Vec2>& places, const Model& coarse) {
  const Particles& p = coarse.particles;
  const NeighbourList near = find_neighbours(places, p.start, 3 * coarse.smoothing_length);
  std::vector<Vec2> result(places.size(), Vec2::Zero());
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::vector<Vec2> points;
    std::vector<double> volumes;
    for (std::int32_t b : near.of(i)) points.push_back(p.start[b]), volumes.push_back(p.volume(b));
    const std::vector<double> weights =
        linear_weights(places[i], points, volumes, 1.5 * coarse.smoothing_length);
    for (std::size_t k = 0; k < weights.size(); ++k) result[i] += weights[k] * p.displacement(near.of(i)[k]);
  }
  return result;
}

}  // namespace

void start_from_coarse(Simulation& simulation) {
  Simulation coarse(coarser(simulation.scene()));
  const RunOutcome outcome = run(coarse, {});
  if (outcome.status == RunStatus::unstable)
    throw std::runtime_error(
        fmt::format("loading.coarse_starts: the run at a spacing of {} m is unstable: {}",
                    coarse.scene().particles.spacing, outcome.message));
  simulation.displace(displacements_at(simulation.model().particles.start, coarse.model()), steps);
}

}  // namespace porosph
