// Excavation in elastic ground against finite elements of the excavated shape: in elastic soil the order of
// weight and digging does not matter to the final state.
#include <algorithm>

#include "solver/reference/fem/compare.hpp"
#include "solver/reference/fem/solve.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/staged.hpp"
#include "vtk_io/fem_mesh.hpp"

using namespace porosph;

namespace {

Case ground(double spacing, double youngs_modulus) {
  Case scene = box_of_soil(static_cast<int>(20 / spacing), static_cast<int>(10 / spacing), spacing);
  scene.soils[0].youngs_modulus = youngs_modulus;
  hold_as_column(scene);
  scene.particles.smoothing_ratio = 1;
  scene.particles.arrangement = Arrangement::stretched;
  scene.loading.adaptive_damping = true;
  scene.formulation.zero_energy_control = 0.1;
  scene.formulation.refresh_strain = 0.02;
  scene.time = {.end = 20, .courant = 0.6};
  scene.stop.unbalanced_force_ratio = 1e-7;
  return scene;
}

/// Upright and 5 m wide, or with a slope of 45 degrees; 4 m deep.
struct Pit {
  Polygon outline, left;
  double displacement;  ///< limit of its error: the upright one's corner is singular
};

Case excavated(Case scene, const Pit& pit) {
  scene.stages.clear();
  scene.soils[0].polygon = pit.left;
  return scene;
}

double worst(const FemCheck& check, const std::string& fields) {
  double most = 0;
  for (const auto& [name, soil] : check.soils)
    for (const auto& [field, d] : soil.fields)
      if (field.starts_with(fields)) most = std::max(most, d.relative);
  return most;
}

}  // namespace

TEST_CASE("excavation in elastic ground against finite elements") {
  const Pit pit = GENERATE(
      Pit{box_outline(-1, 6, 5, 11), {{0, 0}, {20, 0}, {20, 10}, {5, 10}, {5, 6}, {0, 6}}, 0.1},
      Pit{{{-1, 6}, {4, 6}, {9, 11}, {-1, 11}}, {{0, 0}, {20, 0}, {20, 10}, {8, 10}, {4, 6}, {0, 6}}, 0.01});
  Case scene = ground(0.5, 1e9);
  StageCase dig;
  dig.name = "dig", dig.duration = 20, dig.excavate_within = {pit.outline};
  scene.stages = {dig};
  const auto staged = run_stages(scene);
  const Case shape = excavated(scene, pit);
  Simulation at_once(shape);
  run(at_once, {});

  const FemSolution fem = solve_fem(shape, mesh_case(shape, 1));
  const FemCheck by_stages = compare_with_fem(shape, staged->model().particles, fem),
                 directly = compare_with_fem(shape, at_once.model().particles, fem);
  INFO(worst(by_stages, "Effective") << " " << worst(directly, "Effective") << " "
                                     << worst(by_stages, "Displacement") << " "
                                     << worst(directly, "Displacement"));
  CHECK(worst(by_stages, "EffectiveStress") < 0.03);
  CHECK(worst(by_stages, "Displacement") < pit.displacement);
  // No worse than what is computed at once.
  CHECK(worst(by_stages, "EffectiveStress") < 1.2 * worst(directly, "EffectiveStress") + 0.002);
  CHECK(worst(by_stages, "Displacement") < 1.2 * worst(directly, "Displacement") + 0.004);
}

TEST_CASE("in elastic ground the order of digging and weight makes no difference but the strain") {
  const Pit pit{box_outline(-1, 6, 5, 11), {{0, 0}, {20, 0}, {20, 10}, {5, 10}, {5, 6}, {0, 6}}, 0.1};
  const double modulus = GENERATE(5e10, 5e11), spacing = GENERATE(1.0, 0.5);
  Case scene = ground(spacing, modulus);
  StageCase dig;
  dig.name = "dig", dig.duration = 20, dig.excavate_within = {pit.outline};
  scene.stages = {dig};
  const auto staged = run_stages(scene);
  Simulation at_once(excavated(scene, pit));
  run(at_once, {});
  const Particles &p = staged->model().particles, &q = at_once.model().particles;
  REQUIRE(p.size() == q.size());
  double difference = 0, all = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    REQUIRE((p.start[i] - q.start[i]).norm() < 1e-9);
    difference += std::pow(p.stress[i].yy - q.stress[i].yy, 2), all += std::pow(q.stress[i].yy, 2);
  }
  const double strain = 3e-6 * 5e10 / modulus;
  CAPTURE(spacing, modulus);
  CHECK(std::sqrt(difference / all) < 2 * strain);
}
