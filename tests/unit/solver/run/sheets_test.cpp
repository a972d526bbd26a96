// Sheets: against beam theory under known earth pressures, and friction against its coefficient.
#include "solver/run/sheets.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/case/case_file.hpp"
#include "solver/case/check_case.hpp"
#include "solver/case/check_stages.hpp"
#include "solver/run/kept_state.hpp"
#include "solver/run/surface_loads.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/staged.hpp"

using namespace porosph;

namespace {

constexpr double stiff = 1e12;  // EI [N m], EA [N/m]: rigid beside soil

/// Soil `width` wide and `height` high, its lower left corner at the origin, on a roller, not held at its
/// sides.
Case ground(double width, double height, double spacing) {
  Case scene = box_of_soil(2, 2, spacing);
  scene.soils[0].polygon = box_outline(0, 0, width, height);
  scene.soils[0].poissons_ratio = 0.3;
  add_wall(scene, BoundaryKind::roller, {-1, 0}, {width + 1, 0});
  scene.particles.arrangement = Arrangement::surface, scene.particles.smoothing_ratio = 1;
  scene.formulation = default_formulation(Motion::consistent);
  scene.loading.adaptive_damping = true;
  scene.time.courant = 0.7, scene.time.end = 20;
  return scene;
}

SheetCase sheet_between(Point from, Point to, double bending, double axial) {
  SheetCase sheet;
  sheet.name = "sheet", sheet.from = from, sheet.to = to;
  sheet.bending_stiffness = bending, sheet.axial_stiffness = axial, sheet.mass = 1;
  return sheet;
}

void come_to_rest(Simulation& s, double ratio) {
  while (!s.instability() && s.step() < s.last_step() &&
         (s.step() % 20 != 19 || s.unbalanced_force_ratio() > ratio))
    s.advance();
  INFO((s.instability() ? s.instability()->message : "not at rest"));
  REQUIRE(!s.instability());
  s.accelerations();
  CHECK(s.step() < s.last_step());
}

double largest_moment(const Sheet::Profile& profile) {
  double largest = 0;
  for (const Beam::Section& section : profile.sections) largest = std::max(largest, std::abs(section.moment));
  return largest;
}

}  // namespace

TEST_CASE("a rigid cantilever wall carries the moment of earth pressure at rest", "[sheet]") {
  const double height = 5, spacing = GENERATE(0.5, 0.25);
  Case scene = ground(3, height, spacing);
  add_wall(scene, BoundaryKind::roller, {3, 0}, {3, height + 1});
  const bool behind = GENERATE(true, false);  // the sheet stands on the soil's left, or on its right
  if (!behind) scene.boundaries.back().from.x() = scene.boundaries.back().to.x() = 0;
  const double x = behind ? 0 : 3;
  SheetCase wall = sheet_between({x, 0}, {x, height}, stiff, stiff);
  wall.from_end = SheetEnd::fixed;
  scene.sheets.push_back(wall);
  REQUIRE(check_geometry(scene).empty());
  Simulation s(scene);
  come_to_rest(s, 1e-6);
  const Sheet::Profile profile = s.sheets()[0].profile();
  const double gamma = scene.soils[0].unit_weight_unsaturated, k0 = 0.3 / 0.7;
  CAPTURE(spacing, behind);
  const double sign = behind ? 1 : -1;  // soil to the right pushes to the left, where the sheet bends to
  CHECK(sign * profile.sections.front().moment == Approx(k0 * gamma * std::pow(height, 3) / 6).epsilon(0.01));
  CHECK(std::abs(profile.sections.front().shear) == Approx(k0 * gamma * height * height / 2).epsilon(0.01));
}

TEST_CASE("a propped wall carries the moment of earth pressure at rest", "[sheet]") {
  const double height = 5;
  Case scene = ground(3, height, 0.25);
  add_wall(scene, BoundaryKind::roller, {3, 0}, {3, height + 1});
  SheetCase wall = sheet_between({0, height}, {0, 0}, stiff, stiff);
  wall.from_end = wall.to_end = SheetEnd::pinned;
  scene.sheets.push_back(wall);
  Simulation s(scene);
  come_to_rest(s, 1e-6);
  const Sheet::Profile profile = s.sheets()[0].profile();
  const double most = 0.3 / 0.7 * scene.soils[0].unit_weight_unsaturated * std::pow(height, 3);
  CHECK(largest_moment(profile) == Approx(most / (9 * std::sqrt(3))).epsilon(0.01));
}

TEST_CASE("a block slides on a sheet at exactly its coefficient of friction", "[sheet]") {
  const double coefficient = 0.3, reduction = GENERATE(1, 2);
  const double push = GENERATE(0.29, 0.31, 0.4);
  Case scene = ground(2, 1, 0.25);
  scene.boundaries.clear();
  SheetCase base = sheet_between({0, 0}, {2, 0}, stiff, stiff);
  base.from_end = base.to_end = SheetEnd::fixed, base.friction = reduction * coefficient;
  scene.sheets.push_back(base);
  scene.loading.adaptive_damping = false, scene.loading.damping = 0.02, scene.loading.damping_until = 0.5;
  scene.loading.k0_stress = true, scene.loading.k0 = 0;
  scene.loading.horizontal = push;
  scene.time.end = 1.5;
  const auto mean = [](const Simulation& sim) {
    double v = 0;
    for (const Vec2& velocity : sim.model().particles.velocity) v += velocity.x();
    return v / static_cast<double>(sim.model().particles.size());
  };
  Simulation s(scene);
  s.reduce_strength(reduction);
  while (s.time() < 0.9) s.advance();
  const double before = mean(s), time = s.time();
  while (s.step() < s.last_step()) s.advance();
  const double acceleration = (mean(s) - before) / (s.time() - time);
  CAPTURE(push, reduction, before);
  CHECK(acceleration == Approx(9.81 * std::max(0.0, push - coefficient)).margin(0.01));
}

TEST_CASE("a geotextile is pulled out at twice its length times the friction on it", "[sheet]") {
  const double length = 4, coefficient = 0.25, height = 2;
  Case scene = ground(length, height, 0.25);
  scene.boundaries[0].from.x() = -4, scene.boundaries[0].to.x() = 8;
  SheetCase textile = sheet_between({0, 1}, {length, 1}, 0, 1e8);
  textile.friction = coefficient;
  textile.from_end = SheetEnd::pinned;  // as the soil is dragged to the right, off it
  scene.sheets.push_back(textile);
  scene.loading.k0_stress = true, scene.loading.k0 = 0;
  scene.loading.horizontal = GENERATE(0.1, 0.6);
  scene.time.end = 3;
  const double gamma = scene.soils[0].unit_weight_unsaturated;
  const double weight = gamma * length * height, most = 2 * length * gamma * 1 * coefficient;
  Simulation s(scene);
  while (s.time() < (scene.loading.horizontal * weight > most ? 0.3 : 2)) s.advance();
  s.accelerations();
  const Sheet::Profile profile = s.sheets()[0].profile();
  const double pull = profile.sections.front().axial;
  CAPTURE(scene.loading.horizontal);
  CHECK(pull == Approx(std::min(scene.loading.horizontal * weight, most)).epsilon(0.01));
}

TEST_CASE("a sheet does not disturb a uniform stress", "[sheet]") {
  const bool upright = GENERATE(true, false);
  const auto arrangement = GENERATE(Arrangement::surface, Arrangement::stretched);
  const double ratio = GENERATE(1.0, 1.2);
  CAPTURE(upright, static_cast<int>(arrangement), ratio);
  Case scene = ground(3, 4, 0.25);
  scene.particles.arrangement = arrangement, scene.particles.smoothing_ratio = ratio;
  scene.loading.gravity_applied = false;
  scene.boundaries.clear();
  scene.sheets.push_back(upright ? sheet_between({1.5, 4}, {1.5, 1}, 1e6, 1e8)
                                 : sheet_between({0.5, 2}, {2.5, 2}, 1e6, 1e8));
  scene.sheets[0].bonded = true;
  Simulation s(scene);
  Model model = s.model();
  std::ranges::fill(model.particles.stress, Stress{-1e4, -1e4, -1e4, 0});
  const auto dynamics = make_dynamics(scene.formulation, model);
  std::vector<Vec2> a(model.particles.size(), Vec2::Zero());
  dynamics->prepare();
  dynamics->accelerations(a);
  const std::vector<Vec2> outer = surface_vectors(scene, model);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= 1e4 * outer[i] / model.particles.mass[i];
  const int across = upright ? 0 : 1;  // at the ends the surface turns: there something is left along it
  Vec2 before = Vec2::Zero(), most = Vec2::Zero();
  for (const Vec2& each : a) before = before.cwiseMax(each.cwiseAbs());
  Sheet sheet = s.sheets()[0];
  sheet.hold(model, {1, 1e-4}, 1e-4, a);
  for (const Vec2& each : a) most = most.cwiseMax(each.cwiseAbs());
  CHECK(most[across] < 3e-3 * before[across]);
  CHECK(most[1 - across] < 0.2 * before[across]);
  CHECK(largest_moment(sheet.profile()) < 1e-3);
}

TEST_CASE("water that stands at one side of a sheet bends it", "[sheet]") {
  const double height = 5;
  Case scene = ground(6, height, 0.25);
  scene.soils[0].polygon = box_outline(0, 0, 6, 1);
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 2});
  add_wall(scene, BoundaryKind::roller, {6, 0}, {6, 2});
  SheetCase wall = sheet_between({3, 0}, {3, height}, stiff, stiff);
  wall.from_end = SheetEnd::fixed;
  scene.sheets.push_back(wall);
  scene.water.stretches = {{.x_from = -never, .x_to = 3, .level = 4},
                           {.x_from = 3, .x_to = never, .level = 1}};
  REQUIRE(check_geometry(scene).empty());
  Simulation s(scene);
  come_to_rest(s, 1e-5);
  const Sheet::Profile profile = s.sheets()[0].profile();
  const double w = scene.water.unit_weight;
  CHECK(std::abs(profile.sections.front().shear) == Approx(w * (16 - 1) / 2).epsilon(0.01));
  CHECK(std::abs(profile.sections.front().moment) == Approx(w * (64 - 1) / 6).epsilon(0.01));
}

TEST_CASE("a sheet that cannot be is refused", "[sheet]") {
  const auto issues_of = [](auto&& change) {
    Case scene = ground(4, 4, 0.25);
    scene.sheets.push_back(sheet_between({2, 4}, {2, 1}, 1e6, 1e8));
    change(scene, scene.sheets[0]);
    std::string all;
    for (const CaseIssue& issue : check_geometry(scene)) all += issue.key + ": " + issue.message + "\n";
    return all;
  };
  using Catch::Contains;
  CHECK(issues_of([](Case&, SheetCase&) {}).empty());
  CHECK_THAT(issues_of([](Case&, SheetCase& s) { s.to.x() = 2.5; }), Contains("must be level or upright"));
  CHECK_THAT(issues_of([](Case&, SheetCase& s) { s.to.y() = 3.6; }),
             Contains("is shorter than two spacings"));
  CHECK_THAT(issues_of([](Case&, SheetCase& s) { s.from.x() = s.to.x() = 7; }), Contains("touches no soil"));
  CHECK_THAT(issues_of([](Case& c, SheetCase&) {
               add_wall(c, BoundaryKind::roller, {2, 0}, {2, 5});
             }),
             Contains("lies along boundary[1]"));
  CHECK_THAT(issues_of([](Case& c, SheetCase&) { c.formulation.motion = Motion::proposed; }),
             Contains("a sheet needs formulation.motion"));
  CHECK_THAT(issues_of([](Case& c, SheetCase&) { c.particles.arrangement = Arrangement::lattice; }),
             Contains("a sheet needs particles.arrangement"));
  CHECK_THAT(issues_of([](Case& c, SheetCase&) { c.water.mode = WaterMode::steady; }),
             Contains("a sheet cannot be combined with water.mode = \"steady\""));
  CHECK_THAT(issues_of([](Case& c, SheetCase&) {
               c.sheets.push_back(sheet_between({2.5, 4}, {2.5, 1}, 1e6, 1e8));
               c.sheets.back().name = "other";
             }),
             Contains("sheet[1]: must be 1 m or more away from sheet 'sheet'"));
  CHECK_THAT(issues_of([](Case& c, SheetCase&) { c.probes.push_back({.name = "sheet"}); }),
             Contains("sheet[0].name: 'sheet' is the name of a probe too"));
}

namespace {

/// Ground with a sheet to 3 m of its 4 m, beside which 1.5 m are dug after it has come to rest.
Case dug_beside_a_sheet() {
  Case scene = ground(8, 4, 0.25);
  scene.particles.arrangement = Arrangement::stretched;
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 5});
  add_wall(scene, BoundaryKind::roller, {8, 0}, {8, 5});
  scene.sheets.push_back(sheet_between({4, 4}, {4, 1}, 1e6, 1e8));
  scene.sheets[0].friction = 0.3;
  scene.stop.unbalanced_force_ratio = 1e-5;
  StageCase drive, dig, pull;
  drive.name = "drive", drive.duration = 10, drive.sheet_on = {"sheet"};
  dig.name = "dig", dig.duration = 10, dig.excavate_within = {box_outline(-1, 2.5, 4, 5)};
  pull.name = "pull", pull.duration = 10, pull.sheet_off = {"sheet"};
  scene.stages = {drive, dig, pull};
  return scene;
}

}  // namespace

TEST_CASE("a sheet is placed without force, bends as soil is dug, and is pulled out", "[sheet]") {
  const Case scene = dug_beside_a_sheet();
  REQUIRE(check_stages(scene).empty());
  std::vector<double> moments, tops;
  run_stages(scene, [&](const EndedStage& ended, Simulation& s) {
    CAPTURE(ended.name);
    CHECK(ended.outcome.status == RunStatus::equilibrium);
    CHECK(s.sheets().size() == (ended.name == "drive" || ended.name == "dig" ? 1 : 0));
    s.accelerations();
    if (!s.sheets().empty()) moments.push_back(largest_moment(s.sheets()[0].profile()));
    if (!s.sheets().empty()) tops.push_back(s.sheets()[0].profile().moved.front().x());
  });
  REQUIRE(moments.size() == 2);
  CHECK(moments[0] < 0.01 * moments[1]);
  CHECK(tops[1] < -10 * std::abs(tops[0]));
}

TEST_CASE("a state with a sheet is kept and continues to the same bits", "[sheet]") {
  const Case scene = dug_beside_a_sheet();
  StagePlan plan(scene);
  Simulation start(plan.scene());
  run(start, {});
  const HandedOver at_rest = start.hand_over();
  REQUIRE(plan.go_on(start.time()).empty());
  Simulation driven(plan.scene(), {.time = start.time(), .state = &at_rest});
  for (int k = 0; k < 50; ++k) driven.advance();
  const HandedOver state = driven.hand_over();
  REQUIRE(plan.go_on(driven.time()).empty());
  Simulation first(plan.scene(), {.time = driven.time(), .state = &state});
  for (int k = 0; k < 30; ++k) first.advance();
  const KeptState kept(first);
  for (int k = 0; k < 30; ++k) first.advance();
  Simulation second(plan.scene(), {.time = driven.time()});
  kept.restore(second);
  for (int k = 0; k < 30; ++k) second.advance();
  CHECK(KeptState(second) == KeptState(first));
}

TEST_CASE("soil comes off a sheet that it would have to pull", "[sheet]") {
  Case scene = ground(3, 2, 0.25);
  add_wall(scene, BoundaryKind::roller, {3, 0}, {3, 3});
  SheetCase wall = sheet_between({0, 0}, {0, 2}, stiff, stiff);
  wall.from_end = SheetEnd::fixed;
  scene.sheets.push_back(wall);
  scene.loading.horizontal = 1;  // away from the sheet
  scene.time.end = 5;
  Simulation s(scene);
  come_to_rest(s, 1e-5);
  const Sheet::Profile profile = s.sheets()[0].profile();
  for (std::size_t i = 0; i < profile.along.size(); ++i)  // its own weight alone
    CHECK(profile.sections[i].moment == Approx(-9.81 * std::pow(2 - profile.along[i], 2) / 2).margin(0.01));
  double least = never;
  const Particles& p = s.model().particles;
  for (std::size_t a = 0; a < p.size(); ++a) least = std::min(least, p.displacement(a).x());
  CHECK(least > 0);
}
