#include "solver/motion/kernels/vector_units.hpp"

#include <catch2/catch.hpp>

#include "solver/case/case_file.hpp"
#include "solver/motion/consistent.hpp"
#include "solver/neighbours/neighbour_list.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

struct Result {
  std::vector<Vec2> accelerations;
  std::vector<Stress> stress;
};

/// A wet box of 30 x 12 particles, so that there are stretches, their ends and tiles' ends, after a few
/// steps.
Result after_steps(VectorUnits units) {
  Case scene = box_of_soil(30, 12);
  hold_as_column(scene);
  add_water(scene, 8);
  Model model = build_model(scene);
  Particles& p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = {std::sin(3.0 * p.position[i].y()), std::cos(2.0 * p.position[i].x())};
  ConsistentDynamics dynamics(default_formulation(Motion::consistent), model, units);
  Result result{std::vector<Vec2>(p.size()), {}};
  for (int step = 0; step < 5; ++step) {
    dynamics.prepare();
    dynamics.accelerations(result.accelerations);
    const double dt = 1e-4;
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.velocity[i] += dt * result.accelerations[i];
      p.position[i] += dt * p.velocity[i];
    }
    dynamics.strain(dt);
  }
  result.stress = p.stress;
  return result;
}

}  // namespace

TEST_CASE("all vector units compute the same", "[motion]") {
  const std::vector<VectorUnits> units = all_vector_units();
  REQUIRE(units.back() == VectorUnits::portable);
  const Result plain = after_steps(VectorUnits::portable);
  double acceleration = 0, stress = 0;
  for (const Vec2& a : plain.accelerations) acceleration = std::max(acceleration, a.norm());
  for (const Stress& s : plain.stress) stress = std::max(stress, std::abs(s.yy));
  REQUIRE(acceleration > 1);
  REQUIRE(stress > 1);
  for (const VectorUnits u : units) {
    INFO(vector_units_name(u));
    const Result other = after_steps(u);
    double off_a = 0, off_s = 0;
    for (std::size_t i = 0; i < plain.stress.size(); ++i) {
      off_a = std::max(off_a, (other.accelerations[i] - plain.accelerations[i]).norm());
      off_s = std::max(off_s, std::abs(other.stress[i].yy - plain.stress[i].yy));
    }
    CHECK(off_a < 1e-11 * acceleration);
    CHECK(off_s < 1e-12 * stress);
  }
}

TEST_CASE("a lattice shares its stencils, and irregular particles have their own", "[motion]") {
  const auto shared = [](const Case& scene) {
    const Model model = build_model(scene);
    const Particles& p = model.particles;
    std::vector<double> volumes(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) volumes[i] = p.volume(i);
    const CubicSpline<2> kernel(model.smoothing_length);
    const PairStencils stencils = make_pair_stencils(p.position, p.size(), volumes, kernel);
    const NeighbourList list = find_neighbours(p.position, p.size(), kernel.support());
    std::int64_t sharing = 0;
    for (std::int32_t a = 0; a < stencils.particles(); ++a) {
      std::vector<std::int32_t> found;
      Vec2 worst = Vec2::Zero();
      stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
        found.push_back(b);
        const Vec2 to_b = p.position[b] - p.position[a];
        const Vec2 exact = -volumes[b] * kernel.slope(to_b.norm()) * to_b;
        worst = worst.cwiseMax((Vec2(g.x, g.y) - exact).cwiseAbs());
        CHECK(stencils.are_neighbours(a, b));
      });
      CHECK(std::ranges::equal(found, list.of(a)));
      CHECK(worst.maxCoeff() * model.spacing < 1e-12);
      if (stencils.stretch_of[a] != PairStencils::own_list) ++sharing;
    }
    return static_cast<double>(sharing) / static_cast<double>(p.size());
  };
  Case scene = box_of_soil(40, 10);
  CHECK(shared(scene) == Approx(0.9));  // all but two at each end of a row
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = 0.2;
  CHECK(shared(scene) == 0);
}
