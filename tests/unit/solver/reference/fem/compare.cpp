// The comparison of a run with finite elements: its norms by hand, what it leaves out and what it names.
#include "solver/reference/fem/compare.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes.hpp"
#include "solver/case/fem_obstacle.hpp"
#include "solver/model/model.hpp"
#include "solver/reference/exact/finite_strain_column.hpp"
#include "solver/reference/fem/elasticity.hpp"
#include "solver/reference/fem/solve.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

Case scene_of_particles() {
  Case scene = test::foundation();
  scene.particles.spacing = 0.5;
  scene.time.end = 1;
  return scene;
}

/// The foundation's particles with the stress and displacement of finite elements.
Particles exact_particles(const Case& scene, const FemSolution& fem) {
  Particles p = build_model(scene).particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const FemPoint at = fem.at(p.start[i]);
    const Eigen::Vector4d& s = at.effective_stress;
    p.stress[i] = {s[0], s[1], s[2], s[3]};
    p.position[i] = p.start[i] + at.displacement;
  }
  return p;
}

}  // namespace

TEST_CASE("Particles that carry what finite elements say do not differ from them") {
  const Case scene = scene_of_particles();
  const FemSolution fem = solve_fem(scene, mesh_rectangle(scene, 2.5));
  const FemCheck check = compare_with_fem(scene, exact_particles(scene, fem), fem);
  REQUIRE(check.soils.size() == 1);
  const FemSoilCheck& sand = check.soils.at("sand");
  CHECK(sand.particles == 600);  // rollers and a level surface: stress is singular nowhere
  CHECK(sand.left_out == 0);
  for (const auto& [name, d] : sand.fields) {
    CAPTURE(name);
    CHECK(d.relative < 1e-12);
  }
  CHECK(std::isnan(sand.fields.at("EffectiveStress_XY").relative_l2));
  // epsilon_yy = gamma' (10 - y) / M, so its root mean square over the height is the largest over sqrt(3)
  const double largest = (20e3 - 9810) * 10 / test::constrained_modulus(scene.soils[0]);
  CHECK(sand.strain == Approx(largest / std::sqrt(3.0)).epsilon(0.01));
  CHECK(check.limit == Approx(0.05 + sand.strain));
  CHECK(fem_warnings(scene, exact_particles(scene, fem), check).empty());
}

TEST_CASE("Differences are measured by soil and field, and placed") {
  const Case scene = scene_of_particles();
  const FemSolution fem = solve_fem(scene, mesh_rectangle(scene, 2.5));
  Particles p = exact_particles(scene, fem);
  for (Stress& s : p.stress) s.yy *= 1.08;
  for (std::size_t i = 0; i < p.size(); ++i) p.position[i].x() += 0.03 * (p.position[i] - p.start[i]).y();
  const std::size_t outlier = 123;
  p.stress[outlier].xx += 50e3;
  const FemCheck check = compare_with_fem(scene, p, fem);
  const auto& fields = check.soils.at("sand").fields;
  CHECK(fields.at("EffectiveStress_YY").relative_l2 == Approx(0.08).epsilon(1e-6));
  CHECK(fields.at("EffectiveStress_YY").relative == Approx(0.08).epsilon(1e-6));
  CHECK(fields.at("EffectiveStress_XX").max_abs == Approx(50e3));
  CHECK(fields.at("EffectiveStress_XX").x == p.start[outlier].x());
  CHECK(fields.at("EffectiveStress_XX").y == p.start[outlier].y());
  CHECK(fields.at("Displacement_X").relative == Approx(0.03 / 0.2).epsilon(1e-6));  // against a fifth of u

  const auto warnings = fem_warnings(scene, p, check);
  REQUIRE(warnings.size() == 2);
  CHECK_THAT(warnings[0], Contains("sigma'_yy of soil 'sand' is 8 % off finite elements, most at ("));
  CHECK_THAT(warnings[1], Contains("u_x of soil 'sand' is 15 % off"));
}

TEST_CASE("A patch that is wrong is named, though the whole soil is right") {
  const Case scene = scene_of_particles();
  const FemSolution fem = solve_fem(scene, mesh_rectangle(scene, 2.5));
  Particles p = exact_particles(scene, fem);
  const auto in_patch = [&](std::size_t i) {  // 2 m by 2 m, the squares that patches are
    return p.start[i].x() > 4 && p.start[i].x() < 6 && p.start[i].y() > 2 && p.start[i].y() < 4;
  };
  const Particles exact = p;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (in_patch(i)) p.stress[i].yy *= 1.2;
  const FemCheck check = compare_with_fem(scene, p, fem);
  const FemDifference& yy = check.soils.at("sand").fields.at("EffectiveStress_YY");
  CHECK(yy.local == Approx(0.2).epsilon(1e-6));
  CHECK(yy.local_x == Approx(5));
  CHECK(yy.local_y == Approx(3));
  CHECK(yy.relative < check.limit);
  CHECK(check.local_limit == Approx(check.limit + 0.05));
  const auto warnings = fem_warnings(scene, p, check);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0],
             Contains("sigma'_yy of soil 'sand' is 20 % off finite elements around (5, 3), and ") &&
                 Contains(" % in the whole soil; "));

  p = exact;  // beside the surface stress is measured by the weight over a patch's height, 40 kPa
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.start[i].y() > 8 && p.start[i].x() > 4 && p.start[i].x() < 6) p.stress[i].yy += 3e3;
  const FemCheck shallow = compare_with_fem(scene, p, fem);
  CHECK(shallow.soils.at("sand").fields.at("EffectiveStress_YY").local == Approx(3.0 / 40).epsilon(1e-6));
  CHECK(fem_warnings(scene, p, shallow).empty());
}

TEST_CASE("What is warned of begins beyond the limits") {
  const Case scene = scene_of_particles();
  const Particles p = build_model(scene).particles;
  const auto warnings = [&](double relative, double local) {
    FemCheck check;
    check.limit = 0.06, check.local_limit = 0.11;
    check.soils["sand"] = {.particles = 600, .left_out = 0, .strain = 0, .fields = {}};
    FemDifference& d = check.soils["sand"].fields["EffectiveStress_YY"];
    d.relative = relative, d.local = local;
    return fem_warnings(scene, p, check).size();
  };
  CHECK(warnings(0.06, 0.11) == 0);
  CHECK(warnings(0.0601, 0.11) == 1);
  CHECK(warnings(0.06, 0.1101) == 1);
}

TEST_CASE("A number that is not finite is beyond every limit") {
  const Case scene = scene_of_particles();
  const FemSolution fem = solve_fem(scene, mesh_rectangle(scene, 2.5));
  Particles p = exact_particles(scene, fem);
  p.stress[7].yy = std::nan("");
  const FemCheck check = compare_with_fem(scene, p, fem);
  CHECK(std::isnan(check.soils.at("sand").fields.at("EffectiveStress_YY").relative));
  CHECK(fem_warnings(scene, p, check).size() == 1);
}

TEST_CASE("The causes that are known are named") {
  Case scene = scene_of_particles();
  const FemSolution fem = solve_fem(scene, mesh_rectangle(scene, 2.5));
  Particles p = exact_particles(scene, fem);
  for (std::size_t i = 0; i < p.size(); ++i)
    if ((p.start[i] - Point(7.5, 5)).norm() < 3) p.stress[i].yy *= 1.5;  // far from the outline
  const FemCheck check = compare_with_fem(scene, p, fem);
  CHECK_THAT(fem_warnings(scene, p, check).at(0), Contains("the cause is not known"));
  scene.formulation.motion = Motion::conventional;
  CHECK_THAT(fem_warnings(scene, p, check).at(0), Contains("eq. (17), is known to be wrong under water"));
  scene.formulation.motion = Motion::consistent;
  for (double& m : p.mass) m *= 1.04;
  CHECK_THAT(fem_warnings(scene, p, check).at(0), Contains("carry 104.0 % of its area"));
  scene.particles.arrangement = Arrangement::disordered;
  CHECK_THAT(fem_warnings(scene, p, check).at(0), Contains("the particles are disordered"));
  scene.particles.spacing = 3;
  CHECK_THAT(fem_warnings(scene, p, check).at(0),
             Contains("is only 3.3 spacings thick") && Contains("within the kernel's reach of the outline"));
}

TEST_CASE("Lattices that do not fit, and corners, are named by what they do") {
  Case scene = scene_of_particles();
  const auto warning = [&](Point where) {
    scene.soils[0].poissons_ratio = 0.3;
    const Particles p = build_model(scene).particles;
    FemCheck check;
    check.limit = 0.05;
    check.soils["sand"] = {.particles = 1, .left_out = 0, .strain = 0, .fields = {}};
    check.soils["sand"].fields["Displacement_X"] = {
        .relative_l2 = 0.5, .relative = 0.5, .max_abs = 1e-3, .x = where.x(), .y = where.y()};
    return fem_warnings(scene, p, check).at(0);
  };
  scene.water.stretches.clear();
  scene.particles.arrangement = Arrangement::lattice;
  scene.soils[0].polygon = {{0, 0}, {15.2, 0}, {15.2, 10}, {0, 10}};
  CHECK_THAT(warning({14.8, 5}),
             Contains("the lattice does not fit the line x = 15.2 m, 0.2 m from the border"));
  scene.soils[0].polygon = {{0, 0}, {15, 0}, {15, 10}, {0, 10}};
  CHECK_THAT(warning({14.8, 5}), !Contains("does not fit"));

  scene.boundaries = {{BoundaryKind::fixed, {0, 0}, {15, 0}}};
  scene.soils[0].polygon = {{0, 0}, {15, 0}, {5, 4}};
  CHECK_THAT(warning({13.5, 0.3}),
             Contains("the corner at (15, 0) is near, where the soil ends in 22 degrees"));
  scene.soils[0].polygon = {{0, 0}, {15, 0}, {15, 4}, {0, 4}};
  CHECK_THAT(warning({14.5, 0.3}),
             Contains("the corner at (15, 0) is near, where stress grows without bound"));
  scene.soils[0].polygon = {{0, 0}, {7, 0}, {7, 4}, {15, 4}, {15, 8}, {0, 8}};
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {7, 0}},
                      {BoundaryKind::roller, {7, 0}, {7, 4}},
                      {BoundaryKind::roller, {7, 4}, {15, 4}}};
  CHECK_THAT(warning({7.5, 4.5}), Contains("soil slides along both walls and stress grows without bound"));
}

TEST_CASE("Places around singular points are left out") {
  Case scene = scene_of_particles();
  scene.boundaries = {{BoundaryKind::fixed, {0, 0}, {15, 0}}};  // both lower corners are singular now
  const FemSolution fem = solve_fem(scene, mesh_rectangle(scene, 1));
  const FemSoilCheck sand = compare_with_fem(scene, exact_particles(scene, fem), fem).soils.at("sand");
  std::int64_t near = 0;
  for (const Point& x : build_model(scene).particles.start)
    for (const Point& corner : {Point(0, 0), Point(15, 0)}) near += (x - corner).norm() < 2.5;
  std::int64_t at_crests = 0;
  for (const Point& x : build_model(scene).particles.start)
    for (const Point& corner : {Point(0, 10), Point(15, 10)}) at_crests += (x - corner).norm() < 1.25;
  CHECK(sand.left_out == near + at_crests);
  CHECK(sand.particles == 600 - near - at_crests);
}

// What small strain itself costs: the limit is widened by no more than that. Under water the loss of buoyancy
// hides most of it.
TEST_CASE("Finite elements of small strain are off by less than the strain") {
  for (const double modulus : {1e6, 3e6, 1e7})
    for (const bool wet : {false, true}) {
      Column column{.height = 10,
                    .bulk_modulus = modulus,
                    .shear_modulus = modulus / 2,
                    .unit_weight_saturated = 20e3,
                    .unit_weight_unsaturated = 20e3,
                    .unit_weight_water = 9810};
      if (wet) column.water_level = 15;
      const FiniteStrainColumn exact(column);
      const double m = modulus * (1 + 2.0 / 3), weight = wet ? 20e3 - 9810 : 20e3;
      double difference_u = 0, size_u = 0, difference_s = 0, size_s = 0, strain = 0;
      for (double y = 0.05; y < 10; y += 0.1) {
        const double u = -weight / m * (10 * y - y * y / 2), s = -weight * (10 - y);
        difference_u += std::pow(exact.displacement(y) - u, 2), size_u += u * u;
        difference_s += std::pow(exact.vertical_stress(y) - s, 2), size_s += s * s;
        strain += s * s / (m * m) / 100;
      }
      CAPTURE(modulus, wet, std::sqrt(strain));
      const double off = std::sqrt(difference_u / size_u) / std::sqrt(strain);
      CHECK(off < 1);
      if (!wet) CHECK(off > 0.4);
      CHECK(std::sqrt(difference_s / size_s) < std::sqrt(strain));
    }
}

TEST_CASE("Only what is linear is compared") {
  Case scene = scene_of_particles();
  CHECK(fem_obstacle(scene).empty());
  const auto with = [&](auto&& change) {
    Case other = scene;
    change(other);
    return fem_obstacle(other);
  };
  CHECK_THAT(with([](Case& c) { c.soils[0].no_tension = true; }), Contains("'sand' carries no tension"));
  CHECK_THAT(with([](Case& c) { c.soils[0].velocity.x() = 1; }), Contains("initial velocity"));
  CHECK_THAT(with([](Case& c) { c.loading.gravity_applied = false; }), Contains("weightless"));
  CHECK_THAT(with([](Case& c) { c.loading.k0_stress = true; }), Contains("K0"));
  CHECK_THAT(with([](Case& c) {
               c.water.level_over_time = {{0, 15}, {1, 12}};
             }),
             Contains("the water moves"));
}
