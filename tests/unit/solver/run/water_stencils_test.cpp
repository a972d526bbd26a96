#include "solver/run/water_stencils.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "solver/case/case_file.hpp"
#include "solver/model/model.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// Ground whose top row lies on its surface, in half cells.
Case ground(BoundaryKind sides) {
  Case scene = box_of_soil(8, 6, 0.5);
  hold_as_column(scene);
  scene.boundaries[1].kind = scene.boundaries[2].kind = sides;
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

double size(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0,
                         [](double s, double x) { return s + std::abs(x); });
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

TEST_CASE("pore water is conserved with half cells on the surface, as drawn and moved", "[water][dynamic]") {
  const Case scene = ground(GENERATE(BoundaryKind::roller, BoundaryKind::periodic));
  const bool moved = GENERATE(false, true);
  Model model = build_model(scene);
  REQUIRE(std::ranges::any_of(model.particles.fill, [](double fill) { return fill < 0.6; }));
  WaterStencils stencils(scene, model);
  if (moved) {
    for (Vec2& x : model.particles.position) x += Vec2(0.02 * std::sin(x.y()), 0.03 * std::sin(2 * x.x()));
    stencils.renew(model.particles);
    std::swap(model.particles.position[3], model.particles.position[20]);  // as many pairs, but others
    stencils.renew(model.particles);
  }

  const std::size_t n = model.particles.size();
  std::vector<double> head(n), other(n), spread(n), spread_of_other(n);
  Noise noise(1);
  for (std::size_t a = 0; a < n; ++a) head[a] = noise(), other[a] = noise();
  stencils.inertia().apply(head, spread);
  stencils.inertia().apply(other, spread_of_other);
  CHECK(std::abs(sum(spread)) < 1e-12 * size(spread));
  CHECK(product(other, spread) == Approx(product(head, spread_of_other)).epsilon(1e-10));
  CHECK(product(head, spread) > 0);
  if (!moved) return;  // water flows out at the surface
  std::vector<double> flow(n);
  stencils.slope().multiply(head, flow);
  CHECK(std::abs(sum(flow)) < 1e-12 * size(flow));
}

TEST_CASE("water leaves moved soil at its free surface, and nowhere inside", "[water][dynamic]") {
  Case scene = ground(BoundaryKind::roller);
  const bool half_cells = GENERATE(false, true);
  if (!half_cells) scene.particles.arrangement = Arrangement::lattice;
  Model model = build_model(scene);
  Particles& p = model.particles;
  WaterStencils stencils(scene, model);
  stencils.renew(p);
  std::vector<double> depth(p.size()), lost(p.size());
  double top = 0;
  for (const Vec2& x : p.position) top = std::max(top, x.y() + (half_cells ? 0 : 0.25));
  for (std::size_t a = 0; a < p.size(); ++a) depth[a] = top - p.position[a].y();
  stencils.slope().multiply(depth, lost);
  for (std::size_t a = 0; a < p.size(); ++a) {
    const bool uppermost = depth[a] < 0.3;
    CHECK(stencils.lies_on_free_surface(a) == (half_cells && uppermost));
    if (!uppermost) CHECK(stencils.outlet(a) == 0);
    // The critical gradient passes through as it comes.
    if (uppermost && !half_cells) CHECK(stencils.outlet(a) * depth[a] == Approx(-lost[a]).epsilon(1e-6));
  }
  Noise noise(2);
  for (Vec2& x : p.position) x += 0.15 * scene.particles.spacing * noise.vector();
  stencils.renew(p);
  for (std::size_t a = 0; a < p.size(); ++a)
    if (depth[a] > 0.6) CHECK(stencils.outlet(a) == 0);
}
