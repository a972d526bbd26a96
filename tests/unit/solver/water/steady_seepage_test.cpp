#include "solver/water/flow/steady_seepage.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes.hpp"

using namespace porosph;
using namespace porosph::test;

namespace {

const Point a{0, 0}, b{1, 0}, c{1, 1}, d{0, 1};

/// Largest error of a head that falls by 1 m per metre from 10 m, along x or along y.
double worst_of_linear(const Seepage& s, bool along_y) {
  double worst = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
    worst = std::max(worst,
                     std::abs(s.solved.head[i] - (10 - (along_y ? s.position(i).y() : s.position(i).x()))));
  return worst;
}

}  // namespace

TEST_CASE("uniform flow is exact in any arrangement and direction", "[water]") {
  const auto [arrangement, disorder] =
      GENERATE(std::pair{Arrangement::lattice, 0.0}, std::pair{Arrangement::stretched, 0.0},
               std::pair{Arrangement::surface, 0.0}, std::pair{Arrangement::disordered, 0.1},
               std::pair{Arrangement::disordered, 0.3});
  const bool along_y = GENERATE(false, true);
  CAPTURE(static_cast<int>(arrangement), disorder, along_y);
  Case scene = seepage_box(1, 1, 0.05, arrangement);
  scene.particles.disorder = disorder;
  const double k = scene.soils[0].permeability.x();
  if (along_y)
    scene.water.faces.insert(scene.water.faces.end(), {head_face(a, b, 10), head_face(c, d, 9)});
  else
    scene.water.faces.insert(scene.water.faces.end(), {head_face(d, a, 10), head_face(b, c, 9)});
  const Seepage s(scene);
  CHECK(worst_of_linear(s, along_y) < 1e-8);
  CHECK(s.through[1] / k == Approx(1).epsilon(0.002));
  CHECK(s.through[2] == Approx(-s.through[1]).epsilon(1e-8));
  const std::vector<Vec2> w = s.flow->velocities(s.solved.head, s.solved.faces, s.model.particles.position);
  for (const Vec2& v : w) CHECK((v / k - (along_y ? Vec2(0, 1) : Vec2(1, 0))).norm() < 1e-6);
}

TEST_CASE("flow of anisotropic soil is exact along its axes", "[water]") {
  const Point k = GENERATE(Point(1e-4, 1e-5), Point(1e-6, 1e-4), Point(2e-5, 1e-5));
  const bool along_y = GENERATE(false, true);
  Case scene = seepage_box(1, 1, 0.05);
  scene.soils[0].permeability = k;
  if (along_y)
    scene.water.faces.insert(scene.water.faces.end(), {head_face(a, b, 10), head_face(c, d, 9)});
  else
    scene.water.faces.insert(scene.water.faces.end(), {head_face(d, a, 10), head_face(b, c, 9)});
  const Seepage s(scene);
  CHECK(worst_of_linear(s, along_y) < 1e-8);
  CHECK(s.through[1] / (along_y ? k.y() : k.x()) == Approx(1).epsilon(1e-8));
}

TEST_CASE("flow across layers whose permeability differs a thousandfold is that of both in series",
          "[water]") {
  const double disorder = GENERATE(0.0, 0.1);
  const double contrast = GENERATE(1e-3, 0.1, 1e3);
  CAPTURE(disorder, contrast);
  Case scene = seepage_box(1, 0.5, 0.05, disorder > 0 ? Arrangement::disordered : Arrangement::stretched);
  scene.particles.disorder = disorder;
  SoilCase upper = scene.soils[0];
  upper.name = "upper";
  for (Point& p : upper.polygon) p.y() += 0.5;
  upper.permeability *= contrast;
  scene.soils.push_back(upper);
  scene.water.faces.insert(scene.water.faces.end(), {head_face(a, b, 10), head_face(c, d, 9)});
  const Seepage s(scene);
  const double k = scene.soils[0].permeability.x(), exact = 1 / (0.5 / k + 0.5 / (k * contrast));
  CHECK(s.through[1] / exact == Approx(1).epsilon(disorder > 0 ? 0.005 : 1e-6));
}

TEST_CASE("infiltration to a water table is of second order", "[water]") {
  // Gardner: kr = q + (1 - q) exp(-alpha y) with q the rate over k, water table at y = 0.
  const double alpha = 1.5, rate = 0.3;
  std::vector<double> errors;
  for (const double spacing : {0.2, 0.1, 0.05}) {
    Case scene = seepage_box(2 * spacing, 4, spacing);
    const double k = scene.soils[0].permeability.x();
    scene.soils[0].retention = {.model = RetentionModel::gardner, .alpha = alpha};
    scene.water.faces.push_back(head_face({0, 0}, {2 * spacing, 0}, 0));
    scene.water.faces.push_back(
        {.kind = FaceKind::flux, .from = {0, 4}, .to = {2 * spacing, 4}, .rate = rate * k});
    const Seepage s(scene);
    double error = 0, size = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double exact = std::log(rate + (1 - rate) * std::exp(-alpha * s.position(i).y())) / alpha;
      error += std::pow(s.pressure_head(i) - exact, 2), size += exact * exact;
    }
    errors.push_back(std::sqrt(error / size));
    CHECK(s.through[2] == Approx(rate * k * 2 * spacing));
    CHECK(s.through[1] == Approx(-s.through[2]).epsilon(1e-8));
  }
  CAPTURE(errors[0], errors[1], errors[2]);
  CHECK(errors[1] < 0.005);
  CHECK(std::log2(errors[0] / errors[1]) > 1.8);
  CHECK(std::log2(errors[1] / errors[2]) > 1.8);
}

TEST_CASE("the discharge of a dam with a seepage face is that of its integral", "[water]") {
  // With any kr(psi) and a closed top: q L / k = int Phi dy on one side less that on the other, Phi = int kr.
  const auto [height, tail, length] = GENERATE(table<double, double, double>({{24, 4, 16}, {10, 2, 5}}));
  const double spacing = height / 24, alpha = 2 / spacing;
  Case scene = seepage_box(length, height, spacing);
  const double k = scene.soils[0].permeability.x();
  scene.soils[0].retention = {.model = RetentionModel::gardner, .alpha = alpha};
  scene.water.faces.push_back(head_face({0, 0}, {0, height}, height));
  scene.water.faces.push_back(head_face({length, 0}, {length, height}, tail));
  const Seepage s(scene);
  const auto phi = [&](double psi) { return psi < 0 ? std::exp(alpha * psi) / alpha : 1 / alpha + psi; };
  const std::vector<double> psi = s.flow->pressure_heads_at_patches(s.solved.head);
  double sides = height * (height / 2 + 1 / alpha), exit = tail;
  for (std::size_t p = 0; p < psi.size(); ++p) {
    const HydraulicPatch& patch = s.outline.patches[p];
    const Vec2 middle = s.outline.middle(patch);
    if (middle.x() < length - 1e-9) continue;
    const bool under_water = middle.y() < tail, open = s.solved.faces.open(static_cast<std::int32_t>(p));
    if (open) exit = std::max(exit, middle.y() + (patch.to - patch.from) / 2);
    sides -= (patch.to - patch.from) * phi(under_water ? tail - middle.y() : open ? 0 : psi[p]);
  }
  CHECK(s.through[1] == Approx(-s.through[2]).epsilon(1e-8));
  CHECK(s.through[1] * length / k == Approx(sides).epsilon(0.003));
  CHECK(s.through[1] * 2 * length / k ==
        Approx(height * height - tail * tail).epsilon(0.03));  // Dupuit, Charny
  CHECK(exit > tail);
}

TEST_CASE("soil that no head reaches is named", "[water]") {
  Case scene = seepage_box(1, 1, 0.1);
  SoilCase apart = scene.soils[0];
  apart.name = "apart";
  for (Point& p : apart.polygon) p.x() += 3;
  scene.soils.push_back(apart);
  scene.water.faces.push_back(head_face(a, d, 1));
  const Model model = build_model(scene);
  const HydraulicOutline outline = hydraulic_outline(scene.soils, scene.water.faces, 0.1);
  std::vector<double> height(model.particles.size(), 0);
  const DarcyFlow flow(make_flow_pairs(scene.soils, outline, model.particles, 0.1), outline,
                       {Retention({}, 0.1), Retention({}, 0.1)}, model.particles.soil, height);
  const std::int32_t found = flow.unreached(FaceConditions(outline, scene.water.faces));
  REQUIRE(found >= 0);
  CHECK(model.particles.position[found].x() > 2);
}
