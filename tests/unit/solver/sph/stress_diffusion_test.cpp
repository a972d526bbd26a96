// Diffusion of stress in soil that shears: what it smooths, and what it leaves alone.
#include "solver/sph/consistent/stress_diffusion.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

constexpr int rows = 8;
constexpr double spacing = 0.5;

/// A square of soil that yields, all of which has been sheared by `strain`.
struct Sheared {
  explicit Sheared(double strain, bool goes_on = false) {
    Case scene = box_of_soil(rows, rows, spacing);
    for (const double x : {0.0, rows * spacing})
      if (goes_on) add_wall(scene, BoundaryKind::periodic, {x, 0}, {x, rows * spacing});
    scene.soils[0].law = LawKind::drucker_prager;
    scene.soils[0].strength = {.cohesion = 1e3, .friction_angle = 30};
    model = build_model(scene);
    reference = make_reference(model, {}, Surroundings(model).find(model));
    const std::vector<std::int32_t> neighbours(size(), 20);
    const std::vector<std::uint8_t> at_walls(size(), 0);
    loose.take(model, neighbours, at_walls, true);
    std::vector<Mat2> correction;
    for (std::size_t a = 0; a < size(); ++a) correction.push_back(reference.correction[a]);
    diffusion = StressDiffusion(size());
    diffusion.take(reference, model, loose, correction);
    std::fill_n(diffusion.sheared(), size(), strain);
  }
  std::size_t size() const { return model.particles.size(); }

  /// As many steps as diffuse once. Returns the elastic energy that is lost.
  double diffuse() {
    ConsistentArrays arrays{};
    arrays.reference = reference.view(model.particles);
    arrays.state.stress = &model.particles.stress.data()->xx;
    arrays.diffusion = diffusion.view(model.particles);
    double lost = 0;
    for (int step = 0; step < StressDiffusion::steps_between; ++step)
      lost += diffusion.apply(model, consistent_kernels(vector_units()), arrays);
    return lost;
  }
  /// Gives each particle the stress of_place(x, y).
  template <class Of>
  void give(Of&& of_place) {
    for (std::size_t a = 0; a < size(); ++a)
      model.particles.stress[a] = of_place(model.particles.position[a].x(), model.particles.position[a].y());
  }
  double alternation() const {
    double sum = 0;
    for (const Stress& s : model.particles.stress) sum += s.xx * s.xx;
    return std::sqrt(sum / static_cast<double>(size()));
  }

  Model model;
  ReferenceConfiguration reference;
  LooseParticles loose;
  StressDiffusion diffusion;
};

Stress linear(double x, double y) { return {-1e3 * x, -2e3 * y, 500 * (x + y), 300 * x - 100 * y}; }

Stress alternating(double x, double y) {
  return {std::lround(2 * (x + y) / spacing) % 4 == 0 ? 100.0 : -100.0, 0, 0, 0};
}

}  // namespace

TEST_CASE("a stress that is linear does not diffuse, up to the surface") {
  Sheared soil(0.01);
  soil.give(linear);
  soil.diffuse();
  for (std::size_t a = 0; a < soil.size(); ++a) {
    const Vec2& x = soil.model.particles.position[a];
    const Stress s = soil.model.particles.stress[a], expected = linear(x.x(), x.y());
    CHECK(std::sqrt((s + expected * -1.0).squared()) < 1e-9 * std::sqrt(expected.squared()) + 1e-9);
  }
}

TEST_CASE("a stress that alternates diffuses with the strain, by no more than is stable") {
  const auto left = [](double strain) {
    Sheared soil(strain);
    soil.give(alternating);
    const double before = soil.alternation();
    CHECK(soil.diffuse() > 0);
    return soil.alternation() / before;
  };
  CHECK(left(0.004) == Approx(1 - 2 * (1 - left(0.002))).epsilon(0.02));
  CHECK(left(0.01) < 0.9);
  CHECK(left(10) == Approx(left(0.01)).epsilon(1e-12));
  CHECK(left(10) > 0.2);
}

TEST_CASE("what has not sheared does not diffuse, and shear counts once") {
  Sheared soil(0);
  soil.give(alternating);
  CHECK(soil.diffuse() == 0);
  CHECK(soil.alternation() == Approx(100).epsilon(1e-12));
  std::fill_n(soil.diffusion.sheared(), soil.size(), 0.002);
  soil.diffuse();
  const double once = soil.alternation();
  CHECK(once < 100);
  soil.diffuse();
  CHECK(soil.alternation() == once);
}

TEST_CASE("soils do not share their stress") {
  Sheared soil(0.01);
  soil.give([](double, double y) { return y < 0.5 * rows * spacing ? Stress{100, 0, 0, 0} : Stress{}; });
  Particles& p = soil.model.particles;
  soil.model.soils.push_back(soil.model.soils[0]);
  for (std::size_t a = 0; a < p.size(); ++a) p.soil[a] = p.position[a].y() < 0.5 * rows * spacing ? 1 : 0;
  std::vector<Mat2> correction(soil.size(), Mat2::Identity());
  soil.diffusion.take(soil.reference, soil.model, soil.loose, correction);
  soil.diffuse();
  for (std::size_t a = 0; a < p.size(); ++a) CHECK(p.stress[a].xx == (p.soil[a] == 1 ? 100 : 0));
}

TEST_CASE("across periodic sides stress diffuses as it does inside") {
  const auto diffused = [](int shift) {
    Sheared soil(0.004, true);
    soil.give([&](double x, double y) {
      const long column = (std::lround(x / spacing - 0.5) + shift) % rows,
                 row = std::lround(y / spacing - 0.5);
      const auto mixed = static_cast<double>((17 * column * column + 29 * row + 7 * column * row) % 41);
      return Stress{10 * mixed, -5 * mixed, 0, mixed};
    });
    soil.diffuse();
    std::map<std::pair<long, long>, double> at;
    for (std::size_t a = 0; a < soil.size(); ++a) {
      const Vec2& x = soil.model.particles.position[a];
      at[{(std::lround(x.x() / spacing - 0.5) + shift) % rows, std::lround(x.y() / spacing - 0.5)}] =
          soil.model.particles.stress[a].xx;
    }
    return at;
  };
  const auto here = diffused(0), shifted = diffused(3);
  for (const auto& [place, stress] : here) CHECK(shifted.at(place) == Approx(stress).margin(1e-9));
}
