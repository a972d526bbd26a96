#include "solver/boundary/load.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "solver/model/model.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// Grows along x and over time; part of it follows the surface's normal.
class Ramp final : public Load {
 public:
  Vec2 traction(const Vec2& place, const Vec2& normal, double time) const override {
    return time * (Vec2(2e3, -5e3) * place.x() - 1e3 * normal);
  }
};

/// The top of a box of soil 4 m wide, seen from right to left: the soil lies on its left.
LoadedSurface top_of(const Model& model, double height, int pieces) {
  LoadedSurface surface;
  surface.load = std::make_shared<Ramp>();
  std::vector<std::int32_t> all(model.particles.size());
  std::iota(all.begin(), all.end(), 0);
  for (int k = 0; k < pieces; ++k) {
    const Vec2 from(4 - 4.0 * k / pieces, height), to(4 - 4.0 * (k + 1) / pieces, height);
    std::vector<std::int32_t> near;
    for (const std::int32_t b : all)
      if ((model.particles.position[b] - (from + to) / 2).norm() < 2 * model.smoothing_length)
        near.push_back(b);
    surface.pieces.push_back(surface_piece(from, to, near, model.particles, model.smoothing_length));
  }
  return surface;
}

}  // namespace

TEST_CASE("a load's force and moment are those of its traction, also when it changes along the surface") {
  const double height = 3;
  const Model model = build_model(box_of_soil(16, 12, 0.25));
  const Particles& p = model.particles;
  const std::vector<LoadedSurface> surfaces = {top_of(model, height, 64)};
  std::vector<Vec2> a(p.size(), Vec2::Zero());
  add_loads(surfaces, p, 2, a);
  Vec2 force = Vec2::Zero();
  double moment = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    force += p.mass[i] * a[i];
    moment += p.mass[i] * (p.position[i].x() * a[i].y() - p.position[i].y() * a[i].x());
  }
  // integral of 2 ((2, -5) x - (0, 1)) kPa over x = 0 to 4 m at y = 3 m
  CHECK(force.x() == Approx(2 * 2e3 * 8).epsilon(1e-9));
  CHECK(force.y() == Approx(2 * (-5e3 * 8 - 1e3 * 4)).epsilon(1e-9));
  const double about_origin = 2 * (-5e3 * 64.0 / 3 - 1e3 * 8) - height * 2 * 2e3 * 8;
  CHECK(moment == Approx(about_origin).epsilon(1e-4));  // midpoint rule: 1 / (4 pieces^2)
}
