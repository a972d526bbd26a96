// Mohr and Coulomb's and Tresca's laws: where stress ends, and along which plastic strain.
#include "solver/soil/mohr_coulomb.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <random>

#include "solver/soil/drucker_prager.hpp"
#include "solver/soil/tresca.hpp"

using namespace porosph;

namespace {

using Vec3 = Eigen::Vector3d;

const Elasticity elastic = Elasticity::from_young(20e6, 0.3);
constexpr double radian = std::numbers::pi / 180;

Eigen::Matrix3d stiffness() {
  const double lambda = elastic.bulk_modulus - 2 * elastic.shear_modulus / 3;
  return Eigen::Matrix3d::Constant(lambda) + 2 * elastic.shear_modulus * Eigen::Matrix3d::Identity();
}

/// The six planes of the surface, or of a potential, i the larger stress: normals and their yield functions.
struct Planes {
  std::vector<Vec3> normal;
  double c_cos_phi;
  Planes(double sine, double c) : c_cos_phi(c) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (i != j) {
          Vec3 n = Vec3::Zero();
          n[i] = 1 + sine, n[j] = sine - 1;
          normal.push_back(n);
        }
  }
  double yield(std::size_t k, const Vec3& s) const { return normal[k].dot(s) - 2 * c_cos_phi; }
};

/// Whether the strain is a sum of these normals with factors >= 0: by every pair and triple of them.
bool is_in_cone(const Vec3& strain, const std::vector<Vec3>& normals) {
  const double small = 1e-7 * strain.norm();
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t j = i; j < normals.size(); ++j)
      for (std::size_t k = j; k < normals.size(); ++k) {
        Eigen::Matrix3d m;
        m << normals[i], normals[j], normals[k];
        const Vec3 factors = m.completeOrthogonalDecomposition().solve(strain);
        if ((m * factors - strain).norm() < small && factors.minCoeff() > -1e-7 * factors.norm()) return true;
      }
  return false;
}

}  // namespace

TEST_CASE("stress returns to Mohr and Coulomb's surface along the plastic potential", "[soil]") {
  const auto [c, phi, psi] = GENERATE(table<double, double, double>(
      {{5e3, 30, 30}, {5e3, 30, 0}, {5e3, 30, 10}, {0, 35, 5}, {10e3, 0, 0}, {2e3, 45, 20}}));
  const Planes surface(std::sin(phi * radian), c * std::cos(phi * radian)),
      potential(std::sin(psi * radian), 0);
  const MohrCoulombSurface m{std::sin(phi * radian), c * std::cos(phi * radian), std::sin(psi * radian),
                             1e300};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> component(-1e5, 6e4);
  int planes = 0, edges = 0, apexes = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Vec3 a(component(random), component(random), component(random));
    std::sort(a.data(), a.data() + 3, std::greater<>());
    const Returned r = returned({a[0], a[1], a[2]}, m, elastic);
    const Vec3 b(r.stress.s1, r.stress.s2, r.stress.s3);
    std::vector<Vec3> active;
    for (std::size_t k = 0; k < 6; ++k) {
      REQUIRE(surface.yield(k, b) < 1e-10 * 1e5);
      if (surface.yield(k, b) > -1e-9 * 1e5) active.push_back(potential.normal[k]);
    }
    REQUIRE(b[0] >= b[1] - 1e-9 * 1e5);
    REQUIRE(b[1] >= b[2] - 1e-9 * 1e5);
    const Vec3 strain = stiffness().inverse() * (a - b);
    if (surface.yield(1, a) <= 0) {  // s1 and s3
      CHECK((a - b).norm() == 0);
      continue;
    }
    (active.size() == 1 ? planes : active.size() == 2 ? edges : apexes) += 1;
    // At the apex flow that is not associated has no direction of its own.
    if (active.size() <= 2 || phi == psi) CHECK(is_in_cone(strain, active));
    const Vec3 deviator = strain - Vec3::Constant(strain.mean());
    CHECK(r.plastic_strain == Approx(std::sqrt(2.0 / 3) * deviator.norm()).epsilon(1e-9));
  }
  CHECK(planes > 100);
  CHECK(edges > 50);
  CHECK((phi == 0 || apexes > 50));
}

TEST_CASE("in space and turned by any angle, a return is that of the principal stresses", "[soil]") {
  const MohrCoulombSurface m{0.5, 4e3, 0.1, 3e3};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> component(-8e4, 4e4);
  for (int k = 0; k < 500; ++k) {
    const double xx = component(random), yy = component(random), zz = component(random),
                 xy = component(random);
    const ReturnedInPlane r = returned_in_plane(xx, yy, zz, xy, m, elastic);
    const auto values = [](double a, double b, double c, double d) {
      Eigen::Matrix3d s;
      s << a, d, 0, d, b, 0, 0, 0, c;
      return Vec3(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(s).eigenvalues());
    };
    const Vec3 a = values(xx, yy, zz, xy), b = values(r.xx, r.yy, r.zz, r.xy);
    const Returned expected = returned({a[2], a[1], a[0]}, m, elastic);
    const bool yields = 1.5 * a[2] - 0.5 * a[0] > 8e3 || a[2] > 3e3;
    CHECK(b[2] == Approx(yields ? expected.stress.s1 : a[2]).margin(1e-6));
    CHECK(b[0] == Approx(yields ? expected.stress.s3 : a[0]).margin(1e-6));
    // The principal directions stay.
    CHECK(r.xy * (xx - yy) == Approx(xy * (r.xx - r.yy)).margin(1e-2));
  }
}

TEST_CASE("no principal stress is left beyond the tension cut-off", "[soil]") {
  const double tension = GENERATE(0.0, 2e3, 6e3);
  const MohrCoulombSurface m{std::sin(30 * radian), 10e3 * std::cos(30 * radian), 0.2, tension};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> component(-1e5, 6e4);
  for (int trial = 0; trial < 2000; ++trial) {
    Vec3 a(component(random), component(random), component(random));
    std::sort(a.data(), a.data() + 3, std::greater<>());
    const PrincipalStress b = returned({a[0], a[1], a[2]}, m, elastic).stress;
    CHECK(b.s1 <= tension + 1e-9 * 1e5);
    CHECK(b.s1 >= b.s2 - 1e-9 * 1e5);
    CHECK(b.s2 >= b.s3 - 1e-9 * 1e5);
    CHECK(1.5 * b.s1 - 0.5 * b.s3 - 2 * m.c_cos_phi < 1e-9 * 1e5);
  }
}

TEST_CASE("a crack opens across the largest stress and leaves the others what they were", "[soil]") {
  // Pulled along x with the sides held: beyond the cut-off nothing changes any more.
  const MohrCoulomb law = MohrCoulomb::from_angles(elastic, 20e3, 30, 0, 5e3);
  MohrCoulomb::History q;
  Stress s{-1e3, -30e3, -15e3, 0};
  for (int k = 0; k < 400; ++k) s = law.step(s, Gradient{2e-6, 0, 0, 0}, 1, q);
  const Stress cracked = s;
  for (int k = 0; k < 400; ++k) s = law.step(s, Gradient{2e-6, 0, 0, 0}, 1, q);
  CHECK(s.xx == Approx(5e3).epsilon(1e-12));
  CHECK(s.yy == Approx(cracked.yy).epsilon(1e-12));
  CHECK(s.zz == Approx(cracked.zz).epsilon(1e-12));
}

TEST_CASE("what has opened at the apex closes before it bears", "[soil]") {
  const double rate = 1e-5;
  const auto check = [&](const auto& law) {
    typename std::decay_t<decltype(law)>::History q;
    Stress s{};
    for (int k = 0; k < 50; ++k) s = law.step(s, Gradient{rate, 0, 0, rate}, 1, q);
    CHECK(std::abs(s.mean()) < 1e-6);
    CHECK(q.opening == Approx(100 * rate).epsilon(1e-9));
    for (int k = 0; k < 50; ++k) s = law.step(s, Gradient{-rate, 0, 0, -rate}, 1, q);
    CHECK(std::abs(s.mean()) < 1e-6);
    CHECK(q.opening == Approx(0).margin(1e-15));
    s = law.step(s, Gradient{-rate, 0, 0, -rate}, 1, q);
    CHECK(s.mean() == Approx(-2 * rate * elastic.bulk_modulus).epsilon(1e-9));
  };
  check(DruckerPrager::from_mohr_coulomb(elastic, 0, 30));
  check(MohrCoulomb::from_angles(elastic, 0, 30));
}

TEST_CASE("what has opened across the tension cut-off closes before it bears", "[soil]") {
  const double rate = 1e-5, cut_off = 2e3, elastic_part = cut_off / elastic.bulk_modulus;
  const auto check = [&](const auto& law, auto q) {
    Stress s{};
    for (int k = 0; k < 50; ++k) s = law.step(s, Gradient{rate, 0, 0, rate}, 1, q);
    const double opened = 100 * rate - s.mean() / elastic.bulk_modulus;  // zz may be less than the cut-off
    CHECK(std::max(s.xx, s.yy) == Approx(cut_off).epsilon(1e-12));
    CHECK(q.opening == Approx(opened).epsilon(1e-6));
    REQUIRE(q.opening > 5 * elastic_part);
    const double forgetful = -opened * elastic.bulk_modulus;  // what it would bear at once without memory
    while (q.opening > 2 * rate) {
      s = law.step(s, Gradient{-rate, 0, 0, -rate}, 1, q);
      CHECK(s.mean() > 0.2 * forgetful);  // zz, which does not close, is cut meanwhile
    }
    const double closed = s.mean();
    for (int k = 0; k < 10; ++k) s = law.step(s, Gradient{-rate, 0, 0, -rate}, 1, q);
    CHECK(q.opening == Approx(0).margin(1e-15));
    CHECK(s.mean() < closed - 8 * 2 * rate * elastic.bulk_modulus);
  };
  check(MohrCoulomb::from_angles(elastic, 20e3, 20, 0, cut_off), MohrCoulomb::History());
  Tresca clay{elastic};
  clay.strength = 20e3, clay.tension = cut_off;
  check(clay, clay.at_start(Vec2(0, 0)));
}

TEST_CASE("Tresca's soil bears its undrained strength whatever the pressure, and more below", "[soil]") {
  Tresca law{elastic};
  law.strength = 20e3, law.growth = 1.5e3, law.level = 4;
  const double y = GENERATE(6.0, 4.0, -3.0), p = GENERATE(0.0, -500e3);
  Tresca::History q = law.at_start(Vec2(1, y));
  Stress s{p, p, p, 0};
  for (int k = 0; k < 1000; ++k) s = law.step(s, Gradient{0, 5e-5, 5e-5, 0}, 1, q);
  const double strength = y > 4 ? 20e3 : 20e3 + 1.5e3 * (4 - y);
  CHECK(s.xy == Approx(strength).epsilon(1e-12));
  CHECK(s.mean() == Approx(p).epsilon(1e-12).margin(1e-9));
  CHECK(law.shear_stress(s) == Approx(law.shear_strength(s, q)).epsilon(1e-12));
  CHECK(q.plastic_strain * std::numbers::sqrt3 ==
        Approx(0.1 - strength / elastic.shear_modulus).epsilon(1e-9));
}

TEST_CASE("strength softens from its peak to its residual value", "[soil]") {
  for (const double x : {0.0, 1e-6, 0.3, 1.0, 5.0, 20.0, 39.0})
    CHECK(decay(x) == Approx(std::exp(-x)).epsilon(1e-12));
  CHECK(decay(1e6) < 1e-17);
  const double p0 = -60e3, c = 12e3, phi = 30, c_res = 2e3, phi_res = 20;
  const Softening by = GENERATE(Softening{40, 0}, Softening{0, 25});
  const auto check = [&](const auto& peak) {
    const auto law = peak.softened_to(c_res, phi_res, by);
    typename std::decay_t<decltype(law)>::History q;
    Stress s{p0, p0, p0, 0};
    const auto strength = [&](double left) {
      const double sine = std::sin(phi_res * radian) * (1 - left) + std::sin(phi * radian) * left;
      const double cosine =
          c_res * std::cos(phi_res * radian) * (1 - left) + c * std::cos(phi * radian) * left;
      return cosine - p0 * sine;
    };
    double most = 0;
    for (int k = 0; k < 20000; ++k) {
      const double left = by.left(q.plastic_strain);
      s = law.step(s, Gradient{0, 5e-6, 5e-6, 0}, 1, q);
      if (q.plastic_strain > 0) CHECK(s.xy == Approx(strength(left)).epsilon(1e-9));
      most = std::max(most, s.xy);
    }
    CHECK(most == Approx(strength(1)).epsilon(1e-3));
    CHECK(s.xy == Approx(strength(by.linear > 0 ? 0 : std::exp(-40 * q.plastic_strain))).epsilon(1e-3));
  };
  check(DruckerPrager::from_mohr_coulomb(elastic, c, phi));
  check(MohrCoulomb::from_angles(elastic, c, phi));
}
