// Loads on the soil's surface.
#include "solver/run/surface_loads.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/case/case_file.hpp"
#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

LoadCase pressing(const Point& from, const Point& to, double pressure) {
  LoadCase load;
  load.name = "load", load.from = from, load.to = to;
  load.pressure = load.pressure_to = pressure;
  return load;
}

/// A weightless box, 12 x 8 cells, held as a column, pressed on its top.
Case pressed_box(Arrangement arrangement, double pressure) {
  Case scene = box_of_soil(12, 8, 0.5);
  hold_as_column(scene);
  for (BoundaryCase& b : scene.boundaries)
    if (b.to.y() > 0) b.to.y() += 2;  // walls beside a load extend beyond the soil
  scene.particles.arrangement = arrangement;
  scene.particles.smoothing_ratio = arrangement == Arrangement::surface ? 1 : 1.2;
  scene.formulation = default_formulation(Motion::consistent);
  scene.loading.gravity_applied = false;
  scene.loads.push_back(pressing({0, 4}, {6, 4}, pressure));
  return scene;
}

Vec2 total_force(std::span<const LoadedParticles> loads, double time) {
  Vec2 sum = Vec2::Zero();
  for (const LoadedParticles& l : loads)
    for (std::size_t k = 0; k < l.particles.size(); ++k)
      sum += l.areas[k] * l.load->traction(l.places[k], l.normals[k], time);
  return sum;
}

}  // namespace

TEST_CASE("a pressed column is in balance with its uniform stress to rounding", "[load]") {
  const Arrangement arrangement =
      GENERATE(Arrangement::lattice, Arrangement::fitted, Arrangement::surface, Arrangement::stretched);
  const double q = 30e3;
  Case scene = pressed_box(arrangement, q);
  Model model = build_model(scene);
  const std::vector<LoadedParticles> loads = surface_loads(scene, model);
  const double lateral = scene.soils[0].poissons_ratio / (1 - scene.soils[0].poissons_ratio);
  std::ranges::fill(model.particles.stress, Stress{-lateral * q, -q, -lateral * q, 0});
  const auto dynamics = make_dynamics(scene.formulation, model);
  std::vector<Vec2> a(model.particles.size(), Vec2::Zero());
  dynamics->prepare();
  dynamics->accelerations(a);
  add_surface_loads(loads, model.particles, 0, a);
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, model.particles.mass[i] * a[i].norm());
  CHECK(most < 1e-9 * q * scene.particles.spacing);
  CHECK(total_force(loads, 0).y() == Approx(-q * 6).epsilon(1e-9));
  CHECK(std::abs(total_force(loads, 0).x()) < 1e-9 * q);
}

namespace {

/// On any particle, where the soil of the case has the pressure q [Pa] and its loads act [N/m].
double largest_force(const Case& scene, double q) {
  Model model = build_model(scene);
  const auto loads = surface_loads(scene, model);
  std::ranges::fill(model.particles.stress, Stress{-q, -q, -q, 0});
  const auto dynamics = make_dynamics(scene.formulation, model);
  std::vector<Vec2> a(model.particles.size(), Vec2::Zero());
  dynamics->prepare();
  dynamics->accelerations(a);
  add_surface_loads(loads, model.particles, 0, a);
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, model.particles.mass[i] * a[i].norm());
  return most;
}

}  // namespace

TEST_CASE("all faces of a free box under one pressure are in balance, corners included", "[load]") {
  Case scene = pressed_box(Arrangement::lattice, 0);
  scene.boundaries.clear(), scene.loads.clear();
  const double q = 10e3;
  const Polygon corners{{0, 0}, {6, 0}, {6, 4}, {0, 4}};
  for (std::size_t i = 0; i < 4; ++i) scene.loads.push_back(pressing(corners[i], corners[(i + 1) % 4], q));
  CHECK(largest_force(scene, q) < 1e-9 * q * scene.particles.spacing);
}

TEST_CASE("a round face of short stretches under one pressure is in balance", "[load]") {
  constexpr int corners = 48;  // a bend is in reach of each particle
  constexpr double q = 10e3, turn = 2 * std::numbers::pi / corners;
  Case scene = pressed_box(Arrangement::fitted, 0);
  scene.boundaries.clear(), scene.loads.clear();
  Polygon& ring = scene.soils[0].polygon;
  ring.clear();
  for (int i = 0; i < corners; ++i) ring.push_back({2.5 * std::cos(i * turn), 2.5 * std::sin(i * turn)});
  for (int i = 0; i < corners; ++i) scene.loads.push_back(pressing(ring[i], ring[(i + 1) % corners], q));
  scene.particles.spacing = 0.125;
  // By what is left deeper than the search for the surface.
  CHECK(largest_force(scene, q) < 1e-4 * q * scene.particles.spacing);
  // Each stretch has the force of its length, but for what its neighbours carry of it.
  for (const LoadedParticles& l : surface_loads(scene, build_model(scene)))
    CHECK(total_force(std::span(&l, 1), 0).norm() == Approx(q * 2 * 2.5 * std::sin(turn / 2)).epsilon(0.1));
}

TEST_CASE("a load's force is that of its traction over its stretch and over time", "[load]") {
  Case scene = pressed_box(Arrangement::lattice, 0);
  scene.loads[0] = {.name = "part",
                    .from = {1.5, 4},
                    .to = {4.5, 4},
                    .pressure = 10e3,
                    .pressure_to = 30e3,
                    .traction = {2e3, 0},
                    .traction_to = {2e3, 0},
                    .over_time = {{1, 0}, {3, 1}}};
  const Model model = build_model(scene);
  const auto loads = surface_loads(scene, model);
  CHECK(total_force(loads, 0.5).norm() == 0);
  CHECK(total_force(loads, 2).y() == Approx(-0.5 * 20e3 * 3).epsilon(1e-9));
  CHECK(total_force(loads, 9).x() == Approx(2e3 * 3).epsilon(1e-9));
}

TEST_CASE("a load keeps its force and its place, wherever it ends on a face", "[load]") {
  const Arrangement arrangement =
      GENERATE(Arrangement::lattice, Arrangement::surface, Arrangement::stretched);
  const auto [from, to] =
      GENERATE(std::pair(1.37, 4.21), std::pair(2.1, 2.3), std::pair(0.2, 3.0), std::pair(3.0, 6.0));
  const bool between_walls = GENERATE(true, false);
  CAPTURE(arrangement, from, to, between_walls);
  Case scene = pressed_box(arrangement, 0);
  if (!between_walls) scene.boundaries.resize(1);
  scene.loads[0] = pressing({from, 4}, {to, 4}, 1);
  const Model model = build_model(scene);
  const auto loads = surface_loads(scene, model);
  double place = 0, alternating = 0;
  for (std::size_t k = 0; k < loads[0].particles.size(); ++k) {
    const double x = model.particles.position[loads[0].particles[k]].x();
    place += loads[0].areas[k] * x;
    alternating += std::cos(2 * std::numbers::pi * x) * loads[0].areas[k];  // from column to column
  }
  CHECK(total_force(loads, 0).y() == Approx(from - to).epsilon(1e-9));
  // Beside a corner, what is spread beyond the end has no counterpart.
  const bool inside = from > 1 && to < 5;
  CHECK(place == Approx((to * to - from * from) / 2).margin(inside ? 1e-9 : 0.13));
  if (inside && between_walls) CHECK(std::abs(alternating) < 1e-9);
}

namespace {

/// An embankment whose crest meets a steep slope and a gentle one.
Case crest_between_slopes(Arrangement arrangement) {
  Case scene = pressed_box(arrangement, 0);
  scene.soils[0].polygon = {{0, 0}, {12, 0}, {8, 6}, {6, 6}, {2, 4}, {1, 2}};
  scene.boundaries.clear();
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {12, 0});
  scene.loads[0] = pressing({8, 6}, {6, 6}, 1);
  return scene;
}

}  // namespace

TEST_CASE("pressure and shear on a crest beside a blunt bend have their force", "[load]") {
  const Arrangement arrangement =
      GENERATE(Arrangement::lattice, Arrangement::fitted, Arrangement::surface, Arrangement::stretched);
  CAPTURE(arrangement);
  Case scene = crest_between_slopes(arrangement);
  const Model model = build_model(scene);
  const Vec2 pressed = total_force(surface_loads(scene, model), 0);
  CHECK(pressed.y() == Approx(-2).epsilon(0.01));
  CHECK(std::abs(pressed.x()) < 0.1);
  scene.loads[0] = {.name = "shear",
                    .from = {8, 6},
                    .to = {6, 6},
                    .traction = {1, 0},
                    .traction_to = {1, 0},
                    .over_time = {}};
  const Vec2 sheared = total_force(surface_loads(scene, model), 0);
  CHECK(sheared.x() == Approx(2).epsilon(1e-9));
  CHECK(std::abs(sheared.y()) < 1e-9);
}

TEST_CASE("a column pressed at rest has the stress and the settlement of its theory", "[load]") {
  const double q = 30e3;
  Case scene = pressed_box(Arrangement::surface, q);
  scene.loading.adaptive_damping = true;
  scene.time.courant = 0.6, scene.time.end = 2;
  Simulation s(scene);
  while (s.step() < s.last_step() &&
         (s.step() < 50 || s.step() % 20 != 0 || s.unbalanced_force_ratio() > 1e-7))
    s.advance();
  CHECK(s.step() < s.last_step());
  const Particles& p = s.model().particles;
  const double m = s.model().soils[0].constrained_modulus();
  for (std::size_t i = 0; i < p.size(); ++i) {
    CHECK(p.stress[i].yy == Approx(-q).epsilon(2e-3));  // small strain: q / M = 0.14 %
    CHECK(p.displacement(i).y() == Approx(-q / m * p.start[i].y()).margin(2e-3 * q / m * 4));
  }
}
