#include "solver/sph/kernels/vector_units.hpp"

#include <catch2/catch.hpp>

#include "solver/case/case_file.hpp"
#include "solver/sph/consistent/consistent.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"
#include "solver/sph/paper/paper.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/step_by_hand.hpp"

using namespace porosph;

namespace {

struct Result {
  std::vector<Vec2> accelerations;
  std::vector<Stress> stress;
};

/// A wet box of 30 x 12 particles, so that there are stretches, their ends and tiles' ends, after a few
/// steps.
template <class Form>
Result after_steps(Motion motion, VectorUnits units) {
  Case scene = box_of_soil(30, 12);
  hold_as_column(scene);
  add_water(scene, 8);
  Model model = build_model(scene);
  Particles& p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = {std::sin(3.0 * p.position[i].y()), std::cos(2.0 * p.position[i].x())};
  FormulationCase formulation = default_formulation(motion);
  if (motion != Motion::consistent)
    formulation.artificial_viscosity_alpha = formulation.artificial_viscosity_beta = 0.1;
  Form dynamics(formulation, model, units);
  Result result{std::vector<Vec2>(p.size()), {}};
  step_by_hand(dynamics, model, 1e-4, 5);
  dynamics.prepare();
  dynamics.accelerations(result.accelerations);
  result.stress = p.stress;
  return result;
}

template <class Form>
void check_all_units(Motion motion) {
  const Result plain = after_steps<Form>(motion, VectorUnits::portable);
  double acceleration = 0, stress = 0;
  for (const Vec2& a : plain.accelerations) acceleration = std::max(acceleration, a.norm());
  for (const Stress& s : plain.stress) stress = std::max(stress, std::abs(s.yy));
  REQUIRE(acceleration > 1);
  REQUIRE(stress > 1);
  for (const VectorUnits u : all_vector_units()) {
    INFO(vector_units_name(u));
    const Result other = after_steps<Form>(motion, u);
    double off_a = 0, off_s = 0;
    for (std::size_t i = 0; i < plain.stress.size(); ++i) {
      off_a = std::max(off_a, (other.accelerations[i] - plain.accelerations[i]).norm());
      off_s = std::max(off_s, std::abs(other.stress[i].yy - plain.stress[i].yy));
    }
    CHECK(off_a < 1e-11 * acceleration);
    CHECK(off_s < 1e-12 * stress);
  }
}

}  // namespace

TEST_CASE("all vector units compute the same", "[motion]") {
  REQUIRE(all_vector_units().back() == VectorUnits::portable);
  check_all_units<ConsistentDynamics>(Motion::consistent);
  for (const Motion motion : {Motion::conventional, Motion::proposed, Motion::rho_squared})
    check_all_units<PaperDynamics>(motion);
}

TEST_CASE("particles whose lists are alike are summed together, wherever they have moved to", "[motion]") {
  Case scene = box_of_soil(40, 10);
  Model model = build_model(scene);
  const auto shared = [&] {
    const NeighbourList list =
        find_neighbours(model.particles.position, model.particles.size(), 2.6 * model.spacing);
    const PairLists lists = make_pair_lists(list);
    std::int32_t next = 0, sharing = 0;
    std::int64_t weights = 0;
    for (const PairLists::Stretch& stretch : lists.stretches) {
      CHECK(stretch.first == next);
      next = stretch.last;
      CHECK(stretch.last - stretch.first <= PairLists::longest);
      if (stretch.shared) {
        CHECK(stretch.last - stretch.first >= PairLists::widest);
        sharing += stretch.last - stretch.first;
        weights += (stretch.last - stretch.first) * (stretch.pairs_end - stretch.pairs);
      }
      for (std::int32_t a = stretch.first; a < stretch.last; ++a) {
        std::vector<std::int32_t> found;
        for (std::int32_t k = stretch.pairs; k < stretch.pairs_end; ++k) found.push_back(a + lists.offset[k]);
        for (std::int64_t k = lists.begin[a]; k < lists.begin[a + 1]; ++k)
          if (lists.index[k] != a) found.push_back(lists.index[k]);
        CHECK(std::ranges::equal(found, list.of(a)));
        CHECK((lists.begin[a + 1] - lists.begin[a]) % PairLists::widest == 0);
      }
    }
    CHECK(next == static_cast<std::int32_t>(model.particles.size()));
    CHECK(lists.weights >= weights + std::ssize(lists.index));
    return sharing / static_cast<double>(next);
  };
  CHECK(shared() == Approx(0.9));  // all but two at each end of a row
  for (Vec2& x : model.particles.position)
    x += 0.02 * model.spacing * Vec2(std::sin(5 * x.y()), std::cos(3 * x.x()));
  CHECK(shared() == Approx(0.9));
  std::swap(model.particles.position[0], model.particles.position[200]);
  CHECK(shared() < 0.9);
}

TEST_CASE("a lattice shares its stencils, and irregular particles have their own", "[motion]") {
  const auto shared = [](const Case& scene) {
    const Model model = build_model(scene);
    const Particles& p = model.particles;
    std::vector<double> volumes(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) volumes[i] = p.volume(i);
    const CubicSpline<2> kernel(model.smoothing_length);
    const PairStencils stencils =
        make_pair_stencils(p.position, stencil_neighbours(p.position, p.size(), kernel), volumes, kernel);
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

TEST_CASE("gradients in single precision differ by its rounding, and a constant field still has none",
          "[motion]") {
  Case scene = box_of_soil(20, 12);
  hold_as_column(scene);
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = 0.2;
  const auto gradients = [&](bool single, const Mat2& field) {
    Model model = build_model(scene);
    Particles& p = model.particles;
    for (std::size_t i = 0; i < p.size(); ++i) p.velocity[i] = Vec2(3, 5) + field * p.position[i];
    FormulationCase formulation = default_formulation(Motion::consistent);
    formulation.single_precision = single;
    model.walls.clear();
    ConsistentDynamics dynamics(formulation, model);
    std::vector<Mat2> result(p.size());
    dynamics.prepare();
    dynamics.velocity_gradients(result);
    return result;
  };
  const Mat2 field = (Mat2() << 1, 2, -1, 0.5).finished();
  double off = 0;
  for (const Mat2& m : gradients(true, Mat2::Zero())) CHECK(m.norm() < 1e-12);
  const std::vector<Mat2> exact = gradients(false, field), rounded = gradients(true, field);
  for (std::size_t i = 0; i < exact.size(); ++i) off = std::max(off, (rounded[i] - exact[i]).norm());
  CHECK(off < 1e-6);
  CHECK(off > 0);
}
