#include "solver/run/water_stencils.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "solver/model/model.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// Ground whose top row lies on its surface, in half cells.
Case ground() {
  Case scene = box_of_soil(8, 6, 0.5);
  hold_as_column(scene);
  SoilCase& soil = scene.soils[0];
  soil.porosity = 0.4;
  soil.permeability = {1e-3, 1e-3};
  soil.unit_weight_unsaturated = soil.unit_weight_saturated;
  add_water(scene, 3);
  scene.water.mode = WaterMode::coupled;
  scene.water.coupling.motion = WaterMotion::dynamic;
  scene.particles.arrangement = Arrangement::surface;
  scene.particles.smoothing_ratio = 1;
  scene.formulation = default_formulation(Motion::consistent);
  return scene;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

TEST_CASE("soil that has moved keeps its water, with half cells on its surface too", "[water][dynamic]") {
  const Case scene = ground();
  Model model = build_model(scene);
  REQUIRE(std::ranges::any_of(model.particles.fill, [](double fill) { return fill < 0.6; }));
  WaterStencils stencils(scene, model);
  for (Vec2& x : model.particles.position) x += Vec2(0.02 * std::sin(x.y()), 0.03 * std::sin(2 * x.x()));
  stencils.renew(model.particles);

  const std::size_t n = model.particles.size();
  std::vector<double> head(n), other(n), flow(n), spread(n), spread_of_other(n);
  for (std::size_t a = 0; a < n; ++a) head[a] = std::sin(3.0 * a), other[a] = std::cos(5.0 * a);
  stencils.slope().multiply(head, flow);
  stencils.inertia().apply(head, spread);
  stencils.inertia().apply(other, spread_of_other);

  const auto size = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0, [](double s, double x) { return s + std::abs(x); });
  };
  CHECK(std::abs(sum(flow)) < 1e-12 * size(flow));
  CHECK(std::abs(sum(spread)) < 1e-12 * size(spread));
  const double there = std::inner_product(other.begin(), other.end(), spread.begin(), 0.0);
  const double back = std::inner_product(head.begin(), head.end(), spread_of_other.begin(), 0.0);
  CHECK(there == Approx(back).epsilon(1e-10));
}
