// The parts of a step alone, on one thread, for work on one of them: particles per second.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>

#include "solver/case/case_file.hpp"
#include "solver/soil/laws.hpp"
#include "solver/sph/dynamics.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/law_from_outside.hpp"

namespace porosph {
namespace {

/// A submerged box between rollers, a hundred columns wide for ten thousand particles.
Case column(std::int64_t particles) {
  const int side = static_cast<int>(std::sqrt(static_cast<double>(particles)));
  Case scene = box_of_soil(side, side, 0.2);
  add_water(scene, 0.2 * side + 5);
  hold_as_column(scene);
  return scene;
}

void count_particles(benchmark::State& state, const Model& model) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(model.particles.size()));
}

void neighbour_search(benchmark::State& state) {
  const Model model = build_model(column(state.range(0)));
  const auto& position = model.particles.position;
  for (auto _ : state)
    benchmark::DoNotOptimize(find_neighbours(position, position.size(), 2 * model.smoothing_length));
  count_particles(state, model);
}

void kernel_slope(benchmark::State& state) {
  const CubicSpline<2> kernel(0.24);
  std::vector<double> distance;
  for (int i = 1; i <= 1000; ++i) distance.push_back(0.5e-3 * i);
  for (auto _ : state) {
    double sum = 0;
    for (double r : distance) sum += kernel.slope(r);
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(distance.size()));
}

struct Loaded {
  Model model;
  std::unique_ptr<Dynamics> dynamics;
  std::vector<Vec2> accelerations;

  Loaded(Motion motion, std::int64_t particles) : model(build_model(column(particles))) {
    dynamics = make_dynamics(default_formulation(motion), model);
    accelerations.resize(model.particles.size());
    dynamics->prepare();
  }
};

void geometry(benchmark::State& state, Motion motion) {
  Loaded soil(motion, state.range(0));
  for (auto _ : state) soil.dynamics->prepare();
  count_particles(state, soil.model);
}

void acceleration(benchmark::State& state, Motion motion) {
  Loaded soil(motion, state.range(0));
  for (auto _ : state) soil.dynamics->accelerations(soil.accelerations);
  count_particles(state, soil.model);
}

/// The soil rests, so that it may be strained without end.
void strain(benchmark::State& state, Motion motion) {
  Loaded soil(motion, state.range(0));
  for (auto _ : state) soil.dynamics->strain(1e-4);
  count_particles(state, soil.model);
}

const Elasticity elastic = Elasticity::from_young(15e6, 0.33);  // as in box_of_soil()
const DruckerPrager yielding = DruckerPrager::from_mohr_coulomb(elastic, 5e3, 30, 5);

/// The consistent form with another law: its ratio to LinearElastic's is what the law costs.
void strain_of_law(benchmark::State& state, const AnyLaw& law) {
  Loaded soil(Motion::consistent, state.range(0));
  Soil changed(law);
  changed.add_history(soil.model.particles);
  soil.model.soils[0] = changed;
  for (auto _ : state) soil.dynamics->strain(1e-4);
  count_particles(state, soil.model);
}

BENCHMARK(kernel_slope);
BENCHMARK(neighbour_search)->Arg(1024)->Arg(102400);
BENCHMARK_CAPTURE(geometry, proposed, Motion::proposed)->Arg(1024)->Arg(102400);
BENCHMARK_CAPTURE(acceleration, proposed, Motion::proposed)->Arg(1024)->Arg(102400);
BENCHMARK_CAPTURE(acceleration, consistent, Motion::consistent)->Arg(1024)->Arg(102400);
BENCHMARK_CAPTURE(strain, proposed, Motion::proposed)->Arg(1024)->Arg(102400);
BENCHMARK_CAPTURE(strain, consistent, Motion::consistent)->Arg(1024)->Arg(102400);
BENCHMARK_CAPTURE(strain_of_law, linear_elastic, LinearElastic{elastic})->Arg(10000);
BENCHMARK_CAPTURE(strain_of_law, drucker_prager, yielding)->Arg(10000);
BENCHMARK_CAPTURE(strain_of_law, elastic_from_outside,
                  std::make_shared<FromOutside<LinearElastic>>(LinearElastic{elastic}))
    ->Arg(10000);
BENCHMARK_CAPTURE(strain_of_law, drucker_prager_from_outside,
                  std::make_shared<FromOutside<DruckerPrager>>(yielding))
    ->Arg(10000);

}  // namespace
}  // namespace porosph

int main(int argc, char** argv) {
  omp_set_num_threads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
