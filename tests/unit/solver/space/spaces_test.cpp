// Tensors and soil laws in the plane, around an axis and in space agree where they mean the same.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "solver/soil/laws.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

static_assert(SoilLaw<LinearElastic, Axisymmetric> && SoilLaw<LinearElastic, Solid>);
static_assert(SoilLaw<DruckerPrager, Axisymmetric> && SoilLaw<DruckerPrager, Solid>);

const Elasticity elastic = Elasticity::from_young(20e6, 0.3);

Eigen::Matrix3d matrix(const Symmetric<Solid>& s) {
  return (Eigen::Matrix3d() << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz).finished();
}
Symmetric<Solid> noisy_stress(Noise& noise, double size) {
  return {size * noise(), size * noise(), size * noise(), size * noise(), size * noise(), size * noise()};
}
GradientIn<Solid> gradient(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

/// A step that leads out of the yield surface, in each space, of motion in the x-y plane.
template <class Space>
Symmetric<Space> yielding_step(const Symmetric<Space>& stress, const GradientIn<Space>& g, double& plastic) {
  const DruckerPrager law = DruckerPrager::from_mohr_coulomb(elastic, 3e3, 25, 8);
  DruckerPrager::History q;
  const Symmetric<Space> end = law.step(stress, g, 1e-3, q);
  plastic = q.plastic_strain;
  return end;
}

}  // namespace

TEST_CASE("a rigid rotation about any axis turns the stress and nothing else", "[space]") {
  Noise noise(3);
  for (int k = 0; k < 20; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d(noise(), noise(), noise()).normalized();
    const double angle = 1.2 * noise();
    // Mid-step gradient of that rotation, dt = 1.
    const Eigen::Vector3d w = 2 * std::tan(angle / 2) * axis;
    Eigen::Matrix3d spin;
    spin << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
    const Symmetric<Solid> old = noisy_stress(noise, 1e4);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    const Eigen::Matrix3d expected = turn * matrix(old) * turn.transpose();
    CHECK((matrix(elastic.elastic_step(old, gradient(spin), 1)) - expected).norm() < 1e-8);
  }
}

TEST_CASE("motion in a plane gives the same stress in the plane, around a far axis and in space", "[space]") {
  const Stress plane{-4e4, -9e4, -6e4, 2e4};
  double plastic[3];
  const Stress in_plane = yielding_step(plane, Gradient(0.2, 0.5, -0.3, -0.9), plastic[0]);
  const auto around_axis = yielding_step(Symmetric<Axisymmetric>{-4e4, -9e4, -6e4, 2e4},
                                         GradientIn<Axisymmetric>{0.2, 0.5, -0.3, -0.9, 0}, plastic[1]);
  const auto in_space = yielding_step(Symmetric<Solid>{-4e4, -9e4, -6e4, 2e4, 0, 0},
                                      GradientIn<Solid>{0.2, 0.5, 0, -0.3, -0.9, 0, 0, 0, 0}, plastic[2]);
  CHECK(plastic[0] > 0);
  CHECK(plastic[1] == Approx(plastic[0]).epsilon(1e-12));
  CHECK(plastic[2] == Approx(plastic[0]).epsilon(1e-12));
  const double expected[4] = {in_plane.xx, in_plane.yy, in_plane.zz, in_plane.xy};
  const double axis[4] = {around_axis.xx, around_axis.yy, around_axis.zz, around_axis.xy};
  const double space[4] = {in_space.xx, in_space.yy, in_space.zz, in_space.xy};
  for (int k = 0; k < 4; ++k) {
    CHECK(axis[k] == Approx(expected[k]).epsilon(1e-12));
    CHECK(space[k] == Approx(expected[k]).epsilon(1e-12));
  }
  CHECK(in_space.yz == 0);
  CHECK(in_space.xz == 0);
}

TEST_CASE("a hoop strain presses as a strain in any other direction does", "[space]") {
  const auto hoop =
      elastic.elastic_rate(GradientIn<Axisymmetric>{.xx = 0, .xy = 0, .yx = 0, .yy = 0, .zz = 1e-3});
  const Stress radial = elastic.elastic_rate(Gradient(1e-3, 0, 0, 0));
  CHECK(hoop.zz == Approx(radial.xx));
  CHECK(hoop.xx == Approx(radial.zz));
  CHECK(hoop.yy == Approx(radial.yy));
}

TEST_CASE("stored energy does not depend on the direction from which stress is seen", "[space]") {
  Noise noise(5);
  const Symmetric<Solid> s = noisy_stress(noise, 1e4);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Eigen::Matrix3d t = turn * matrix(s) * turn.transpose();
  const Symmetric<Solid> turned{t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2)};
  CHECK(elastic.stored_energy(turned) == Approx(elastic.stored_energy(s)).epsilon(1e-12));
  CHECK(elastic.stored_energy(Symmetric<Solid>{1e4, -3e4, 2e4, 5e3, 0, 0}) ==
        Approx(elastic.stored_energy(Stress{1e4, -3e4, 2e4, 5e3})));
}
