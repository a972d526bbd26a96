// Inertia of stiff soils on the way to rest: which scenes have it, and how bodies move by it.
#include "solver/run/scaled_inertia.hpp"

#include <catch2/catch.hpp>
#include <functional>

#include "solver/case/case_file.hpp"
#include "solver/case/inertia.hpp"
#include "solver/run/highest_frequency.hpp"
#include "solver/run/kept_state.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

SoilCase soil(const std::string& name, double contrast, const Polygon& outline) {
  SoilCase soil = box_of_soil(1, 1).soils[0];
  soil.name = name, soil.polygon = outline, soil.youngs_modulus *= contrast;
  return soil;
}

/// Soft ground between rollers on a fixed base; a block 100 times as stiff on it, and half in it one 10 000
/// times as stiff. Contrasts as given.
Case blocks_on_ground(double block = 100, double core = 1e4) {
  Case scene = box_of_soil(16, 4, 0.25);
  hold_as_column(scene);
  scene.soils.push_back(soil("block", block, {{1, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 1.5}, {1, 1.5}}));
  scene.soils.push_back(soil("core", core, box_outline(1, 1.5, 2, 2)));
  scene.formulation = default_formulation(Motion::consistent);
  scene.loading.adaptive_damping = true;
  scene.stop.unbalanced_force_ratio = 1e-5;
  scene.time = {.end = 1000, .courant = 0.9};
  return scene;
}

/// Soft ground, and a stiff block beside it that nothing touches.
Case free_block() {
  Case scene = box_of_soil(16, 4, 0.25);
  hold_as_column(scene);
  scene.soils.push_back(soil("block", 50, {{6, 1}, {8, 1}, {8, 3}, {7, 2}}));
  scene.loading.adaptive_damping = true;
  scene.loading.gravity_applied = false;
  return scene;
}

std::vector<Vec2> random_field(std::size_t count, unsigned seed) {
  Noise noise(seed);
  std::vector<Vec2> field(count);
  for (Vec2& v : field) v = noise.vector();
  return field;
}

double power(const Particles& p, std::span<const Vec2> a, std::span<const Vec2> v) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * a[i].dot(v[i]);
  return sum;
}

}  // namespace

TEST_CASE("soils have the inertia that makes them as fast as the softest", "[inertia]") {
  const Case scene = blocks_on_ground();
  const std::vector<double> inertia = inertia_over_mass(scene);
  REQUIRE(inertia.size() == 3);
  CHECK(inertia[0] == 1);
  CHECK(inertia[1] == Approx(100));
  CHECK(inertia[2] == Approx(1e4));
  const Model model = build_model(scene);
  const double m = Elasticity::from_young(15e6, 0.33).constrained_modulus();
  CHECK(model.wave_speed == Approx(std::sqrt(m / (18.6e3 / 9.81))));
}

TEST_CASE("inertia is scaled where nothing but the state of rest is asked for", "[inertia]") {
  using Change = std::function<void(Case&)>;
  const auto is_scaled = [](const Change& change) {
    Case scene = blocks_on_ground();
    change(scene);
    return inertia_over_mass(scene)[2] != 1;
  };
  CHECK(is_scaled([](Case&) {}));
  CHECK(is_scaled([](Case& c) { c.loading.scaled_inertia_auto = false, c.loading.scaled_inertia = true; }));
  const Change asks_for_more[] = {[](Case& c) { c.loading.scaled_inertia_auto = false; },
                                  [](Case& c) { c.loading.adaptive_damping = false; },
                                  [](Case& c) { c.loading.damping_until = 3; },
                                  [](Case& c) { c.formulation.motion = Motion::proposed; },
                                  [](Case& c) { c.soils[1].law = LawKind::tresca; },
                                  [](Case& c) { c.soils[0].no_tension = true; },
                                  [](Case& c) { c.soils[0].angular_velocity = 1; },
                                  [](Case& c) { c.footings.push_back({}); },
                                  [](Case& c) { c.sheets.push_back({}); },
                                  [](Case& c) {
                                    c.loads.emplace_back().over_time = {{0, 0}, {1, 1}};
                                  },
                                  [](Case& c) { c.boundaries[1].kind = BoundaryKind::friction; },
                                  [](Case& c) {
                                    c.water.level_over_time = {{0, 1}, {1, 2}};
                                  },
                                  [](Case& c) { c.water.mode = WaterMode::transient; },
                                  [](Case& c) {
                                    for (Point& corner : c.soils[2].polygon) corner.y() += 1;
                                    c.soils[1].polygon = box_outline(1, 1, 2, 1.5);
                                  }};
  for (const Change& change : asks_for_more) CHECK_FALSE(is_scaled(change));
}

TEST_CASE("inertia of soils that differ little is their mass, unless a case asks", "[inertia]") {
  Case scene = blocks_on_ground(2, 3);
  CHECK(inertia_over_mass(scene) == std::vector<double>{1, 1, 1});
  CHECK_FALSE(ScaledInertia(scene, build_model(scene)).acts());
  scene.loading.scaled_inertia_auto = false, scene.loading.scaled_inertia = true;
  CHECK(inertia_over_mass(scene)[2] == Approx(3));
}

TEST_CASE("a free stiff block takes up the momentum and the spin of its true mass", "[inertia]") {
  const Case scene = free_block();
  const Model model = build_model(scene);
  const ScaledInertia inertia(scene, model);
  REQUIRE(inertia.bodies() == 1);
  const Particles& p = model.particles;
  const std::vector<Vec2> by_mass = random_field(p.size(), 1);
  std::vector<Vec2> scaled = by_mass;
  inertia.scale(scaled);
  Vec2 force = Vec2::Zero(), momentum = Vec2::Zero();
  double torque = 0, spin = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.soil[i] == 0) CHECK(scaled[i] == by_mass[i]);
    if (p.soil[i] != 1) continue;
    const Vec2 x = p.position[i], arm(-x.y(), x.x());
    force += p.mass[i] * by_mass[i], momentum += p.mass[i] * scaled[i];
    torque += p.mass[i] * arm.dot(by_mass[i]), spin += p.mass[i] * arm.dot(scaled[i]);
  }
  CHECK((momentum - force).norm() < 1e-12 * force.norm());
  CHECK(spin == Approx(torque).epsilon(1e-12));
}

TEST_CASE("a free stiff block falls and turns as by its true mass, and has the energy of it", "[inertia]") {
  const Case scene = free_block();
  const Model model = build_model(scene);
  const ScaledInertia inertia(scene, model);
  const Particles& p = model.particles;
  std::vector<Vec2> rigid(p.size(), Vec2::Zero());
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.soil[i] == 1) rigid[i] = Vec2(0.3 - 0.7 * p.position[i].y(), -9.81 + 0.7 * p.position[i].x());
  std::vector<Vec2> scaled = rigid;
  inertia.scale(scaled);
  for (std::size_t i = 0; i < p.size(); ++i) CHECK((scaled[i] - rigid[i]).norm() < 1e-12);
  CHECK(inertia.kinetic_energy(rigid) == Approx(0.5 * power(p, rigid, rigid)).epsilon(1e-12));
}

TEST_CASE("forces do the work that the kinetic energy of the scaled inertia gains", "[inertia]") {
  const Case scene = GENERATE(free_block(), blocks_on_ground());
  const Model model = build_model(scene);
  const ScaledInertia inertia(scene, model);
  const Particles& p = model.particles;
  const std::vector<Vec2> v = random_field(p.size(), 1), by_mass = random_field(p.size(), 2);
  std::vector<Vec2> scaled = by_mass, both = v;
  inertia.scale(scaled);
  for (std::size_t i = 0; i < p.size(); ++i) both[i] += scaled[i];
  // v . M a = (v + a) . M (v + a) / 2 - v . M v / 2 - a . M a / 2
  const double gained =
      inertia.kinetic_energy(both) - inertia.kinetic_energy(v) - inertia.kinetic_energy(scaled);
  CHECK(gained == Approx(power(p, by_mass, v)).epsilon(1e-9));
  CHECK(inertia.kinetic_energy(v) > 0);
}

TEST_CASE("bodies in bodies move with the inertia of what they ride on", "[inertia]") {
  const Case scene = blocks_on_ground();
  const Model model = build_model(scene);
  const ScaledInertia inertia(scene, model);
  CHECK(inertia.bodies() == 2);
  const Particles& p = model.particles;
  std::vector<Vec2> a(p.size(), Vec2::Zero());
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.soil[i] > 0) a[i] = Vec2(0, -9.81);
  CHECK(inertia.kinetic_energy(a) == Approx(0.5 * power(p, a, a)).epsilon(1e-12));  // both of them
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.soil[i] == 1) a[i] = Vec2::Zero();
  const double of_core = 0.5 * power(p, a, a);  // on the block, whose inertia is 100 times its mass
  CHECK(inertia.kinetic_energy(a) > 50 * of_core);
  CHECK(inertia.kinetic_energy(a) < 100 * of_core);
}

TEST_CASE("walls hold stiff bodies", "[inertia]") {
  Case scene = box_of_soil(16, 4, 0.25);
  hold_as_column(scene);
  SECTION("between rollers a layer moves up and down alone") {
    scene.soils.push_back(soil("layer", 100, box_outline(0, 1, 4, 2)));
    for (BoundaryCase& wall : scene.boundaries)
      if (wall.kind == BoundaryKind::roller) wall.to.y() = 2;
    scene.loading.adaptive_damping = true;
    const Model model = build_model(scene);
    const ScaledInertia inertia(scene, model);
    REQUIRE(inertia.bodies() == 1);
    std::vector<Vec2> a(model.particles.size(), Vec2(1, 1));
    inertia.scale(a);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vec2 expected = model.particles.soil[i] == 1 ? Vec2(0.01, 1) : Vec2(1, 1);
      CHECK((a[i] - expected).norm() < 1e-12);
    }
  }
  SECTION("on a fixed base it does not") {
    scene.soils[0].youngs_modulus *= 100;
    scene.soils.push_back(soil("soft", 1, box_outline(0, 1, 4, 2)));
    scene.loading.adaptive_damping = true;
    const ScaledInertia inertia(scene, build_model(scene));
    CHECK(inertia.acts());
    CHECK(inertia.bodies() == 0);
  }
}

TEST_CASE("stiff soil alone is damped, by a tenth of what its acceleration changed", "[inertia]") {
  const Case scene = free_block();
  const Model model = build_model(scene);
  ScaledInertia inertia(scene, model);
  const std::size_t n = model.particles.size();
  const std::vector<Vec2> before = random_field(n, 1), now = random_field(n, 2);
  inertia.take_step(before);
  const std::span<const Vec2> taken = inertia.take_step(now);
  std::vector<Vec2> expected = now;
  for (std::size_t i = 0; i < n; ++i)
    if (model.particles.soil[i] == 1) expected[i] += 0.1 * (now[i] - before[i]);
  inertia.scale(expected);
  for (std::size_t i = 0; i < n; ++i) {
    if (model.particles.soil[i] == 0) CHECK(taken[i] == now[i]);
    CHECK((taken[i] - expected[i]).norm() < 1e-12);
  }
}

TEST_CASE("the time step resolves the fastest vibration of scaled inertia", "[inertia][time]") {
  Case scene = blocks_on_ground();
  scene.time.courant = 0.9;
  const Simulation s(scene);
  REQUIRE(s.inertia().acts());
  const double angle = s.time_step() * highest_frequency(s.scene().formulation, s.model(), s.inertia());
  CHECK(angle < 1.7 * scene.time.courant * (1 + 1e-3));
  CHECK(s.courant() < scene.time.courant);
}

TEST_CASE("a run with scaled inertia goes on to the same bits from any step", "[inertia][resume]") {
  const Case scene = blocks_on_ground();
  Simulation through(scene), resumed(scene);
  REQUIRE(through.inertia().acts());
  for (int step = 0; step < 12; ++step) {
    if (step % 3 != 0) through.accelerations();
    KeptState(through).restore(resumed);
    for (int k = 0; k < 7; ++k) through.advance(), resumed.advance();
    REQUIRE_FALSE(through.instability());
    REQUIRE(KeptState(through) == KeptState(resumed));
  }
}
