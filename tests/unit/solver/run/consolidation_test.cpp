#include "solver/run/consolidation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>

#include "solver/case/case_file.hpp"
#include "solver/reference/exact/consolidation.hpp"

using namespace porosph;

namespace {

constexpr double height = 4;

/// A column between rollers under its own weight and water, which drains at its top.
Case column(int rows, Arrangement arrangement, double permeability = 1e-9) {
  const double width = 4 * height / rows;
  Case scene;
  SoilCase soil;
  soil.name = "clay";
  soil.polygon = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  soil.youngs_modulus = 100e6;  // so that strains stay small, as the exact solution has them
  soil.poissons_ratio = 0.25;
  soil.unit_weight_saturated = 16e3;
  soil.unit_weight_unsaturated = 16e3;
  soil.permeability = {permeability, permeability};
  scene.soils = {soil};
  scene.water.mode = WaterMode::coupled;
  scene.water.stretches = {{-never, never, height + 0.5}};
  scene.water.coupling.bulk_modulus = CouplingCase::incompressible;
  scene.particles.spacing = height / rows;
  scene.particles.arrangement = arrangement;
  scene.particles.smoothing_ratio = 1;
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, height}},
                      {BoundaryKind::roller, {width, 0}, {width, height}},
                      {BoundaryKind::fixed, {0, 0}, {width, 0}}};
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.zero_energy_control = 0.05;
  return scene;
}

struct Column {
  explicit Column(const Case& scene_) : scene(scene_), model(build_model(scene)) {
    dynamics = make_dynamics(scene.formulation, model);
    const double dt = 0.9 * model.smoothing_length / model.wave_speed;
    water = std::make_unique<Consolidation>(scene, model, *dynamics, surface, dt);
  }
  double modulus() const { return model.soils[0].constrained_modulus(); }
  double buoyant() const { return scene.soils[0].unit_weight_saturated - scene.water.unit_weight; }
  double time_of(double factor) const {  ///< c_v t / H^2 = factor
    return factor * height * height * scene.water.unit_weight / (scene.soils[0].permeability.y() * modulus());
  }
  void run_to(double until) {
    while (now < until) now = water->advance(now, until);
  }
  /// Excess pressure over gamma' H.
  double excess(std::size_t a) const {
    return scene.water.unit_weight * water->head()[a] / (buoyant() * height);
  }
  double settlement() const {
    double lowest = 0;
    for (std::size_t a = 0; a < model.particles.size(); ++a)
      lowest = std::min(lowest, model.particles.displacement(a).y());
    return -lowest;
  }
  /// Relative L2 error of the excess pressure against Terzaghi's series for a start that grows with depth, of
  /// which the water bears a `share`.
  double error(double factor, double share = 1) const {
    double error = 0, size = 0;
    for (std::size_t a = 0; a < model.particles.size(); ++a) {
      const double depth = 1 - model.particles.start[a].y() / height;
      const double exact = share * own_weight_pressure(depth, factor);
      error += std::pow(excess(a) - exact, 2), size += exact * exact;
    }
    return std::sqrt(error / size);
  }

  Case scene;
  Model model;
  std::unique_ptr<Dynamics> dynamics;
  SurfaceForces surface;
  std::unique_ptr<Consolidation> water;
  double now = 0;
};

}  // namespace

TEST_CASE("a column consolidates under its weight as in Terzaghi's solution", "[water][consolidation]") {
  const Arrangement arrangement = GENERATE(Arrangement::surface, Arrangement::stretched);
  Column c(column(20, arrangement));
  const double last = c.buoyant() * height * height / (2 * c.modulus());
  for (const double factor : {0.1, 0.2, 0.5, 0.848}) {
    c.run_to(c.time_of(factor));
    CAPTURE(static_cast<int>(arrangement), factor, c.error(factor), c.water->counts().soil_sweeps);
    CHECK(c.error(factor) < 0.006);
    CHECK(c.settlement() / last == Approx(own_weight_degree(factor)).margin(0.004));
    CHECK(std::abs(c.water->imbalance()) < 1e-8 * c.water->drained());
  }
}

TEST_CASE("how long consolidation computes does not depend on permeability", "[water][consolidation]") {
  const auto sweeps = [](double permeability) {
    Column c(column(10, Arrangement::surface, permeability));
    c.run_to(c.time_of(0.2));
    return c.water->counts().soil_sweeps;
  };
  const std::int64_t usual = sweeps(1e-9);
  for (const double k : {1e-12, 1e-6, 1e-2})
    CHECK(static_cast<double>(sweeps(k)) == Approx(usual).epsilon(0.02));
}

TEST_CASE("water of any stiffness drains its part of a load as fast as it should", "[water][consolidation]") {
  constexpr double porosity = 0.4, factor = 0.2;
  std::int64_t usual = 0;
  for (const double bulk_modulus : {CouplingCase::incompressible, 2.2e9, 1e8, 1e7, 1e6}) {
    Case scene = column(20, Arrangement::surface);
    scene.water.coupling.bulk_modulus = bulk_modulus;
    scene.soils[0].porosity = porosity;
    Column c(scene);
    const double share = 1 / (1 + c.modulus() * porosity / bulk_modulus);  // Skempton's B for one dimension
    c.run_to(c.time_of(factor) / share);
    const auto sweeps = c.water->counts().soil_sweeps;
    if (usual == 0) usual = sweeps;
    CAPTURE(bulk_modulus, share, sweeps, usual, c.error(factor, share));
    CHECK(c.error(factor, share) < 0.006);
    // Of 1 MPa the water bears 2 % of the load, and what may be left of forces is a part of its pressure.
    if (share > 0.1) CHECK(static_cast<double>(sweeps) < 1.05 * static_cast<double>(usual));
    CHECK(std::abs(c.water->imbalance()) < 1e-8 * c.water->drained());
  }
}

TEST_CASE("compressible water takes up Skempton's part of a load at once", "[water][consolidation]") {
  const double bulk_modulus = GENERATE(1e7, 1e9);
  Case scene = column(10, Arrangement::surface);
  scene.water.coupling.bulk_modulus = bulk_modulus;
  scene.soils[0].porosity = 0.5;
  scene.water.coupling.first_step = 1e-3;  // nothing has drained
  Column c(scene);
  c.water->advance(0, 1e-3);
  const double water = bulk_modulus / 0.5, part = water / (c.modulus() + water);
  for (std::size_t a = 0; a < c.model.particles.size(); ++a) {
    const double depth = 1 - c.model.particles.start[a].y() / height;
    if (depth > 0.2) CHECK(c.excess(a) == Approx(part * depth).margin(0.01));
  }
}

namespace {

/// A rectangle of soil as heavy as water, so that loads alone strain it, in a lattice with h = dx.
Case weightless(double length, double depth, double youngs_modulus, double poissons_ratio) {
  Case scene;
  SoilCase soil;
  soil.name = "clay";
  soil.polygon = {{0, 0}, {length, 0}, {length, depth}, {0, depth}};
  soil.youngs_modulus = youngs_modulus;
  soil.poissons_ratio = poissons_ratio;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = scene.water.unit_weight;
  scene.soils = {soil};
  scene.water.coupling.bulk_modulus = CouplingCase::incompressible;
  scene.particles.arrangement = Arrangement::lattice;
  scene.particles.smoothing_ratio = 1;
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.zero_energy_control = 0.05;
  return scene;
}

/// The right half of a strip load of 4 m on soil without weight that keeps its water: 40 by 20 particles, or
/// more.
Case strip(double stabilisation, double spacing) {
  Case scene = weightless(16, 8, 20e6, 0.3);
  scene.water.mode = WaterMode::undrained;
  scene.water.stretches = {{-never, never, 8}};
  scene.water.coupling.stabilisation = stabilisation;
  scene.water.coupling.first_step = 1;
  scene.particles.spacing = spacing;
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, 9}},
                      {BoundaryKind::roller, {16, 0}, {16, 9}},
                      {BoundaryKind::fixed, {0, 0}, {16, 0}}};
  LoadCase load;
  load.name = "strip", load.from = {0, 8}, load.to = {2, 8}, load.pressure = load.pressure_to = 10e3;
  scene.loads = {load};
  return scene;
}

struct Loaded {
  explicit Loaded(const Case& scene_) : scene(scene_), model(build_model(scene)) {
    surface = surface_forces(scene, model);
    dynamics = make_dynamics(scene.formulation, model);
    const double dt = 0.9 * model.smoothing_length / model.wave_speed;
    water = std::make_unique<Consolidation>(scene, model, *dynamics, surface, dt);
  }
  /// Of the excess pressures below the third row, what alternates from row to row over all: sixth
  /// differences, in which alternation alone stays as it is.
  double alternation() const {
    const Particles& p = model.particles;
    std::map<std::pair<long, long>, double> at;
    const auto place = [&](std::size_t a) {
      return std::pair{std::lround(p.start[a].x() / model.spacing - 0.5),
                       std::lround(p.start[a].y() / model.spacing - 0.5)};
    };
    for (std::size_t a = 0; a < p.size(); ++a) at[place(a)] = water->head()[a];
    double alternates = 0, all = 0;
    for (const auto& [cell, h] : at) {
      const auto [i, j] = cell;
      if (!at.contains({i, j - 3}) || !at.contains({i, j + 3})) continue;
      const auto beside = [&, i = i, j = j](int rows) { return at.at({i, j - rows}) + at.at({i, j + rows}); };
      alternates += std::pow((20 * h - 15 * beside(1) + 6 * beside(2) - beside(3)) / 64, 2), all += h * h;
    }
    return std::sqrt(alternates / all);
  }
  double settlement() const {
    double lowest = 0;
    for (std::size_t a = 0; a < model.particles.size(); ++a)
      lowest = std::min(lowest, model.particles.displacement(a).y());
    return -lowest;
  }

  Case scene;
  Model model;
  SurfaceForces surface;
  std::unique_ptr<Dynamics> dynamics;
  std::unique_ptr<Consolidation> water;
};

}  // namespace

TEST_CASE("undrained pressure under a strip load does not alternate", "[water][undrained]") {
  for (const double spacing : {0.4, 0.2}) {
    Loaded free(strip(0, spacing)), held(strip(0.25, spacing));
    free.water->advance(0, 1);
    held.water->advance(0, 1);
    CAPTURE(spacing, free.alternation(), held.alternation(), free.settlement(), held.settlement());
    CAPTURE(free.water->counts().soil_sweeps, held.water->counts().soil_sweeps);
    CHECK(held.alternation() < 0.45 * free.alternation());
    CHECK(held.alternation() < (spacing > 0.3 ? 0.01 : 0.005));
    CHECK(held.settlement() == Approx(free.settlement()).epsilon(1e-3));
  }
}

namespace {

/// A quarter of a block between smooth plates that keeps its water, pressed by up to 20 kPa over 1 s. It has
/// no effective stress at the start.
Case block(LawKind law) {
  Case scene = weightless(2, 2, 20e6, 0.3);
  SoilCase& soil = scene.soils[0];
  soil.law = law;
  if (law == LawKind::tresca)
    soil.strength.undrained_strength = 8e3;
  else
    soil.strength.cohesion = 10e3, soil.strength.friction_angle = 30;
  scene.water.mode = WaterMode::undrained;
  scene.water.stretches = {{-never, never, 2}};
  scene.water.coupling.first_step = 0.02;
  scene.particles.spacing = 0.2;
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, 3}}, {BoundaryKind::roller, {0, 0}, {3, 0}}};
  LoadCase load;
  load.name = "plate", load.from = {0, 2}, load.to = {2, 2}, load.pressure = load.pressure_to = 20e3;
  load.over_time = {{0, 0}, {1, 1}};
  scene.loads = {load};
  return scene;
}

}  // namespace

TEST_CASE("soil that keeps its water fails at its undrained strength", "[water][undrained]") {
  // q = 2 s_u; by effective stress s_u = c cos(phi) + p'_0 sin(phi), half of what drained soil bears.
  const LawKind law = GENERATE(LawKind::mohr_coulomb, LawKind::drucker_prager, LawKind::tresca);
  const double strength = law == LawKind::tresca ? 16e3 : 2 * 10e3 * std::sqrt(0.75);
  Loaded b(block(law));
  double now = 0, pressure = 0;
  const auto load_until_failure = [&] {
    while (now < 1) {
      now = b.water->advance(now, 1);
      pressure = 0;
      for (const double h : b.water->head()) pressure += h * b.scene.water.unit_weight / 100;
      if (now * 20e3 < 0.9 * strength) CHECK(pressure == Approx(now * 20e3 / 2).epsilon(0.01));
    }
  };
  CHECK_THROWS_WITH(load_until_failure(),
                    Catch::Contains("does not come to rest") && Catch::Contains("it fails"));
  CAPTURE(static_cast<int>(law), now);
  CHECK(now * 20e3 == Approx(strength).margin(0.02 * 20e3));
}

TEST_CASE("a footing on soil that keeps its water presses on the water alone", "[water][undrained]") {
  Case scene = weightless(4, 4, 10e6, 0.3);
  scene.water.mode = WaterMode::undrained;
  scene.water.stretches = {{-never, never, 4}};
  scene.particles.spacing = 0.4;
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, 5}},
                      {BoundaryKind::roller, {4, 0}, {4, 5}},
                      {BoundaryKind::fixed, {0, 0}, {4, 0}}};
  FootingCase plate;
  plate.name = "plate", plate.from = {0, 4}, plate.to = {4, 4}, plate.force = 40e3;
  plate.over_time = {{0, 0}, {1, 1}};
  scene.footings = {plate};
  scene.time.end = 1;
  Loaded soil(scene);
  for (double now = 0; now < 1;) now = soil.water->advance(now, 1);
  CHECK(soil.surface.footings[0].force() == Approx(40e3).epsilon(1e-4));
  for (const double h : soil.water->head()) CHECK(h * 9.81e3 == Approx(10e3).epsilon(0.002));
}

namespace {

constexpr double width = 4, thickness = 2, force = 20e3;  // a of Mandel [m], height of the quarter, F [N/m]

/// A quarter of Mandel's specimen.
Case specimen(int columns, double nu) {
  Case scene = weightless(width, thickness, 100e6, nu);
  scene.soils[0].permeability = {1e-9, 1e-9};
  scene.water.mode = WaterMode::coupled;
  scene.water.stretches = {{-never, never, thickness}};
  scene.water.faces = {{.kind = FaceKind::closed, .from = {0, thickness}, .to = {width, thickness}}};
  scene.particles.spacing = width / columns;
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, thickness + 1}},
                      {BoundaryKind::roller, {0, 0}, {width + 1, 0}}};
  FootingCase plate;
  plate.name = "plate", plate.from = {0, thickness}, plate.to = {width, thickness};
  plate.rough = false, plate.force = force;
  scene.footings = {plate};
  return scene;
}

}  // namespace

TEST_CASE("pressure rises in the middle of Mandel's specimen", "[water][consolidation]") {
  constexpr double nu = 0.2;
  const Mandel exact(nu);
  Loaded m(specimen(20, nu));
  const double modulus = m.model.soils[0].constrained_modulus();
  const double unit = width * width * m.scene.water.unit_weight / (1e-9 * modulus);
  const Particles& p = m.model.particles;
  double now = 0;
  for (const double factor : {0.02, 0.05, 0.1, 0.5}) {
    while (now < factor * unit) now = m.water->advance(now, factor * unit);
    double worst = 0, highest = 0, low = 1, high = 0;
    for (std::size_t a = 0; a < p.size(); ++a) {
      const double at = p.start[a].x() / width;
      const double found = m.scene.water.unit_weight * m.water->head()[a] / (force / width);
      worst = std::max(worst, std::abs(found - exact.pressure(at, factor)) * 2);
      highest = std::max(highest, 2 * found);
      if (p.start[a].y() < thickness - m.model.spacing) continue;
      const double share = p.start[a].y() / thickness;
      const double strain =
          -p.displacement(a).y() / (share * thickness) * 2 * m.model.soils[0].shear_modulus() * width / force;
      low = std::min(low, strain), high = std::max(high, strain);
    }
    CAPTURE(factor, worst, highest, low, high, exact.strain(factor), m.water->counts().soil_sweeps);
    CHECK(worst < 0.006);
    CHECK(highest == Approx(2 * exact.pressure(0, factor)).margin(0.006));
    CHECK(low == Approx(exact.strain(factor)).epsilon(0.01));  // so the plate stays plane
    CHECK(high == Approx(exact.strain(factor)).epsilon(0.01));
  }
}
