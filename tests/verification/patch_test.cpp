// Patch tests: fields whose gradients the discretisation must reproduce.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <functional>

#include "solver/sph/dynamics.hpp"
#include "tests/step_by_hand.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

const Settings disordered = {"particles.arrangement=disordered", "particles.disorder=0.25"};
const double side = 2;

std::string wall(const char* kind, const char* from, const char* to) {
  return fmt::format("{{kind = '{}', from = {}, to = {}}}", kind, from, to);
}
std::string walls_around(const char* left_right, const char* bottom_top) {
  return fmt::format("boundary=[{}, {}, {}, {}]", wall(left_right, "[0, 0]", "[0, 2]"),
                     wall(left_right, "[2, 0]", "[2, 2]"), wall(bottom_top, "[0, 0]", "[2, 0]"),
                     wall(bottom_top, "[0, 2]", "[2, 2]"));
}

Settings joined(Settings a, const Settings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A block at rest whose fields the test imposes.
struct Block {
  explicit Block(const Settings& settings)
      : block(scene("patch", settings)),
        model(build_model(block)),
        dynamics(make_dynamics(block.formulation, model)) {}

  void stress(const std::function<Stress(const Vec2&)>& field) {
    Particles& p = model.particles;
    for (std::size_t i = 0; i < p.size(); ++i) p.stress[i] = field(p.position[i]);
  }
  void velocity(const std::function<Vec2(const Vec2&)>& field) {
    Particles& p = model.particles;
    for (std::size_t i = 0; i < p.size(); ++i) p.velocity[i] = field(p.position[i]);
  }
  std::vector<Vec2> accelerations() { return accelerations_of(*dynamics, model); }
  std::vector<Mat2> velocity_gradients() { return velocity_gradients_of(*dynamics, model); }
  /// Farther from free faces than particles whose neighbours see them.
  bool is_inside(std::size_t i) const {
    const Vec2& x = model.particles.position[i];
    const double margin = 4 * model.smoothing_length;
    return x.minCoeff() > margin && x.maxCoeff() < side - margin;
  }

  Case block;
  Model model;
  std::unique_ptr<Dynamics> dynamics;
};

const Stress uniform{.xx = -3e4, .yy = -5e4, .zz = -2e4, .xy = 1e4};
const Stress diagonal{.xx = -3e4, .yy = -5e4, .zz = -2e4, .xy = 0};

/// The largest error of acceleration times rho dx, over the stress: 1 means that a stress of this size is
/// lost over one spacing.
double largest_residual(Block& block, const Vec2& exact, bool inside_only) {
  const std::vector<Vec2> a = block.accelerations();
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!inside_only || block.is_inside(i))
      largest = std::max(largest, (a[i] - exact).norm() * block.model.particles.density[i]);
  return largest * block.model.spacing / std::abs(uniform.yy);
}

double largest_gradient_error(Block& block, const Mat2& exact) {
  double largest = 0;
  for (const Mat2& g : block.velocity_gradients()) largest = std::max(largest, (g - exact).norm());
  return largest / exact.norm();
}

Settings motion(const char* name) { return {fmt::format("formulation.motion={}", name)}; }

}  // namespace

TEST_CASE("patch: gradients of linear velocities are exact on disordered particles") {
  const Mat2 gradient = (Mat2() << 0.3, -0.7, 0.4, 0.2).finished();
  for (const char* form : {"consistent", "proposed", "conventional", "rho_squared"}) {
    const Settings settings = joined(disordered, motion(form));
    Block block(settings);
    block.velocity([&](const Vec2& x) { return Vec2(gradient * x + Vec2(1, 2)); });
    expect({"patch", settings, "velocity gradient, disordered, free sides", "linear field", metres(0.1)},
           largest_gradient_error(block, gradient), 5e-14, scientific);
  }
}

TEST_CASE("patch: gradients of linear velocities are exact at rollers and fixed walls") {
  const Settings rollers =
      joined(disordered, {fmt::format("boundary=[{}, {}]", wall("roller", "[0, 0]", "[0, 2]"),
                                      wall("roller", "[0, 0]", "[2, 0]"))});
  Block corner(rollers);
  const Mat2 stretch = (Mat2() << 0.3, 0, 0, -0.2).finished();
  corner.velocity([&](const Vec2& x) { return Vec2(stretch * x); });
  expect(
      {"patch", rollers, "velocity gradient, disordered, rollers at two sides", "linear field", metres(0.1)},
      largest_gradient_error(corner, stretch), 5e-14, scientific);

  const Settings fixed =
      joined(disordered, {fmt::format("boundary=[{}]", wall("fixed", "[0, 0]", "[2, 0]"))});
  Block bottom(fixed);
  const Mat2 shear = (Mat2() << 0, 0.3, 0, -0.2).finished();
  bottom.velocity([&](const Vec2& x) { return Vec2(shear * x); });
  expect({"patch", fixed, "velocity gradient, disordered, fixed bottom", "linear field", metres(0.1)},
         largest_gradient_error(bottom, shear), 5e-14, scientific);
}

TEST_CASE("patch: uniform stress moves nothing inside a regular block") {
  for (const char* form : {"consistent", "proposed", "conventional", "rho_squared"}) {
    const Settings settings = motion(form);
    Block block(settings);
    block.stress([](const Vec2&) { return uniform; });
    expect({"patch", settings, "uniform stress, lattice: rho a dx / stress, inside", "0", metres(0.1)},
           largest_residual(block, Vec2::Zero(), true), 5e-14, scientific);
    CHECK(largest_residual(block, Vec2::Zero(), false) > 0.1);  // the free faces do feel it
  }
}

TEST_CASE("patch: uniform stress between walls moves nothing at all") {
  for (const char* form : {"consistent", "proposed"}) {
    const Settings rollers = joined(motion(form), {walls_around("roller", "roller")});
    Block sliding(rollers);
    sliding.stress([](const Vec2&) { return diagonal; });
    expect({"patch", rollers, "uniform stress between rollers, lattice: rho a dx / stress", "0", metres(0.1)},
           largest_residual(sliding, Vec2::Zero(), false), 5e-14, scientific);

    const Settings mixed = joined(motion(form), {walls_around("roller", "fixed")});
    Block held(mixed);
    held.stress([](const Vec2&) { return diagonal; });
    expect({"patch", mixed, "uniform stress between rollers and fixed walls, lattice: rho a dx / stress", "0",
            metres(0.1)},
           largest_residual(held, Vec2::Zero(), false), 5e-14, scientific);
  }
}

TEST_CASE("patch: the divergence of linear stress is exact inside, and up to fixed walls") {
  const auto linear = [](const Vec2& x) {
    return Stress{.xx = 1e4 * x.x(), .yy = -5e4 + 2e4 * x.y(), .zz = 0, .xy = 5e3 * x.x()};
  };
  const Vec2 divergence(1e4, 2e4 + 5e3);
  for (const char* form : {"consistent", "proposed", "conventional"}) {
    const Settings settings = motion(form);
    Block block(settings);
    block.stress(linear);
    expect({"patch", settings, "linear stress, lattice: rho a dx / stress, inside", "its divergence",
            metres(0.1)},
           largest_residual(block, divergence / block.model.particles.density[0], true), 5e-14, scientific);
  }
  const Settings held = {walls_around("fixed", "fixed")};
  Block block(held);
  block.stress(linear);
  expect({"patch", held, "linear stress between fixed walls, lattice: rho a dx / stress", "its divergence",
          metres(0.1)},
         largest_residual(block, divergence / block.model.particles.density[0], false), 5e-14, scientific);
}

// The weak test: the power of the forces on any linear motion is that of the stress.
TEST_CASE("patch: disordered particles under uniform stress keep the power of linear motions") {
  const Mat2 motion_gradient = (Mat2() << 0.3, -0.7, 0.4, 0.2).finished();
  Block block(disordered);
  block.stress([](const Vec2&) { return uniform; });
  const Particles& p = block.model.particles;
  const std::vector<Vec2> a = block.accelerations();
  double power = 0, exact = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    power += p.mass[i] * a[i].dot(motion_gradient * p.position[i]);
    exact -= p.volume(i) * uniform.in_plane().cwiseProduct(motion_gradient).sum();
  }
  expect({"patch", disordered, "power of the forces of a uniform stress on linear motion, disordered",
          "- stress : gradient", metres(0.1)},
         std::abs(power / exact - 1), 5e-14, scientific);
}

TEST_CASE("patch: uniform stress moves disordered particles unless gradients are closed") {
  const auto residual = [](const Settings& settings) {
    Block block(settings);
    block.stress([](const Vec2&) { return uniform; });
    return largest_residual(block, Vec2::Zero(), true);
  };
  const std::string what = "uniform stress, displaced by up to dx / 4: largest rho a dx / stress, inside";
  expect({"patch", disordered, what, "0", metres(0.1)}, residual(disordered), 5e-3, scientific);
  for (const char* setting : {"formulation.closed_gradients=false", "formulation.motion=proposed"}) {
    const Settings open = joined(disordered, {setting});
    expect({"patch", open, what, "0", metres(0.1)}, residual(open), 1, scientific);
    CHECK(residual(open) > 0.1);
  }
}
