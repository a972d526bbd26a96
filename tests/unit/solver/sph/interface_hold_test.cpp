// What holds the outer rows of stiff soil where it meets soft soil.
#include "solver/sph/consistent/interface_hold.hpp"

#include <catch2/catch.hpp>

#include "solver/case/case_file.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// Stiff soil on soft soil of half the height, between rollers on a fixed base.
Case stiff_on_soft(double contrast) {
  Case scene = box_of_soil(16, 16);
  SoilCase above = scene.soils[0];
  scene.soils[0].polygon = box_outline(0, 0, 8, 4);
  above.name = "above", above.polygon = box_outline(0, 4, 8, 8), above.youngs_modulus *= contrast;
  scene.soils.push_back(above);
  hold_as_column(scene);
  scene.formulation = default_formulation(Motion::consistent);
  return scene;
}

struct Held {
  explicit Held(const Case& scene)
      : model(build_model(scene)),
        reference(make_reference(model, scene.formulation, Surroundings(model).find(model))),
        hold(reference, model) {}

  std::vector<Vec2> forces() {
    std::vector<Vec2> f(model.particles.size(), Vec2::Zero());
    hold.add_forces(reference, model.particles, f);
    for (std::size_t i = 0; i < f.size(); ++i) f[i] *= model.particles.mass[i];
    return f;
  }
  bool in_outer_row(std::size_t i) const {
    return model.particles.soil[i] == 1 && reference.points[i].y() < 4 + model.spacing;
  }
  double modulus() const { return model.soils[1].constrained_modulus(); }

  Model model;
  ReferenceConfiguration reference;
  InterfaceHold hold;
};

}  // namespace

TEST_CASE("stiff soil that turns and strains evenly is not held at its interface", "[interface]") {
  Case scene = stiff_on_soft(100);
  scene.boundaries.clear();
  scene.particles.arrangement = GENERATE(Arrangement::lattice, Arrangement::disordered);
  scene.particles.disorder = scene.particles.arrangement == Arrangement::disordered ? 0.2 : 0;
  Held held(scene);
  REQUIRE(held.hold.acts());
  const Mat2 change = (Mat2() << 0.1, 0.3, -0.4, 0.2).finished();
  Noise noise(1);
  for (std::size_t i = 0; i < held.model.particles.size(); ++i)
    held.model.particles.position[i] += held.model.particles.soil[i] == 1
                                            ? Vec2(change * held.reference.points[i] + Vec2(1, 2))
                                            : Vec2(0.1 * noise.vector());
  for (const Vec2& f : held.forces()) CHECK(f.norm() < 1e-12 * held.modulus());
}

TEST_CASE("what moves in the outer row of stiff soil alone is pulled back", "[interface]") {
  const bool whole_row = GENERATE(false, true);
  CAPTURE(whole_row);
  Case scene = stiff_on_soft(100);
  scene.boundaries.clear();
  Held held(scene);
  Particles& p = held.model.particles;
  const Vec2 shift(2e-3, 1e-3);
  const auto middle = [&](std::size_t i) {
    return held.in_outer_row(i) && std::abs(held.reference.points[i].x() - 3.75) < 0.1;
  };
  for (std::size_t i = 0; i < p.size(); ++i)
    if (whole_row ? held.in_outer_row(i) : middle(i)) p.position[i] += shift;
  const std::vector<Vec2> forces = held.forces();
  Vec2 sum = Vec2::Zero();
  double torque = 0, largest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 x = held.reference.points[i];
    sum += forces[i], torque += x.x() * forces[i].y() - x.y() * forces[i].x();
    largest = std::max(largest, forces[i].norm());
    if (p.soil[i] == 0) CHECK(forces[i] == Vec2::Zero());
    if (!middle(i)) continue;
    // The row has its share in the fit, which is what makes it softer than one particle.
    const double part = (whole_row ? 0.02 : 0.24) * held.modulus();
    CHECK(forces[i].dot(shift) < -part * shift.squaredNorm());
    CHECK(forces[i].dot(shift) > -0.28 * held.modulus() * shift.squaredNorm());
    CHECK(std::abs(forces[i].x() * shift.y() - forces[i].y() * shift.x()) < 1e-9 * forces[i].dot(-shift));
  }
  CHECK(sum.norm() < 1e-12 * largest);
  CHECK(std::abs(torque) < 1e-11 * largest);
}

TEST_CASE("an energy stands behind what holds a stiff soil's rows", "[interface]") {
  Held held(stiff_on_soft(1000));  // with walls beside it
  Particles& p = held.model.particles;
  Noise noise(2);
  std::vector<Vec2> one(p.size()), other(p.size());
  for (Vec2& u : one) u = noise.vector();
  for (Vec2& u : other) u = noise.vector();
  const auto forces_under = [&](const std::vector<Vec2>& u) {
    for (std::size_t i = 0; i < p.size(); ++i) p.position[i] = held.reference.points[i] + u[i];
    return held.forces();
  };
  const auto work = [](const std::vector<Vec2>& f, const std::vector<Vec2>& u) {
    double sum = 0;
    for (std::size_t i = 0; i < f.size(); ++i) sum += f[i].dot(u[i]);
    return sum;
  };
  const std::vector<Vec2> of_one = forces_under(one), of_other = forces_under(other);
  CHECK(work(of_one, one) < 0);
  CHECK(work(of_one, other) == Approx(work(of_other, one)).epsilon(1e-10));
}

TEST_CASE("rows are held where an elastic soil is thirty times as stiff as its neighbour", "[interface]") {
  CHECK(Held(stiff_on_soft(31)).hold.acts());
  CHECK(Held(stiff_on_soft(1 / 31.0)).hold.acts());
  CHECK_FALSE(Held(stiff_on_soft(29)).hold.acts());
  Case scene = stiff_on_soft(100);
  scene.soils[1].polygon = box_outline(0, 4, 8, 4.5);  // a lone row has nothing behind it
  CHECK_FALSE(Held(scene).hold.acts());
  scene = stiff_on_soft(100);
  scene.soils[1].law = LawKind::tresca, scene.soils[1].strength.undrained_strength = 1e5;
  CHECK_FALSE(Held(scene).hold.acts());
}
