// Drucker and Prager's law along paths whose end is known in closed form.
#include "solver/soil/drucker_prager.hpp"

#include <catch2/catch.hpp>

#include "solver/soil/mohr_coulomb.hpp"

using namespace porosph;

namespace {

const Elasticity elastic = Elasticity::from_young(20e6, 0.3);
constexpr double cohesion = 4e3, friction = 25, radians = std::numbers::pi / 180;

/// The stress after `steps` equal steps of the strain `total` from `start`.
Stress along(const DruckerPrager& law, Stress stress, const Gradient& total, int steps, double& plastic) {
  DruckerPrager::History q;
  const Gradient rate(total.xx / steps, total.xy / steps, total.yx / steps, total.yy / steps);
  for (int i = 0; i < steps; ++i) stress = law.step(stress, rate, 1, q);
  plastic = q.plastic_strain;
  return stress;
}

}  // namespace

TEST_CASE("sheared at constant volume, soil has Mohr and Coulomb's strength", "[soil]") {
  const double phi = GENERATE(0.0, 20.0, 35.0);
  const DruckerPrager law = DruckerPrager::from_mohr_coulomb(elastic, cohesion, phi);
  const double p0 = 50e3;
  double plastic = 0;
  const Stress end = along(law, {-p0, -p0, -p0, 0}, {0, 0.025, 0.025, 0}, 1000, plastic);
  const double strength = p0 * std::sin(phi * radians) + cohesion * std::cos(phi * radians);
  CHECK(end.xy == Approx(strength).epsilon(1e-8));
  CHECK(end.mean() == Approx(-p0).epsilon(1e-12));
  // All strain beyond the elastic is plastic: gamma = 0.05.
  CHECK(plastic * std::numbers::sqrt3 == Approx(0.05 - strength / elastic.shear_modulus).epsilon(1e-8));
}

TEST_CASE("in a biaxial test the passive strength is Rankine's", "[soil]") {
  // sigma_xx is held by a strain rate that is solved for in each step.
  const DruckerPrager law = DruckerPrager::from_mohr_coulomb(elastic, cohesion, friction);
  const double s3 = -30e3, kp = std::pow(std::tan((45 + friction / 2) * radians), 2);
  Stress stress{s3, s3, s3, 0};
  DruckerPrager::History q;
  for (int i = 0; i < 4000; ++i) {
    double low = -1e-4, high = 1e-4;
    for (int k = 0; k < 60; ++k) {
      DruckerPrager::History copy = q;
      const double middle = 0.5 * (low + high);
      (law.step(stress, Gradient{middle, 0, 0, -1e-5}, 1, copy).xx > s3 ? high : low) = middle;
    }
    stress = law.step(stress, Gradient{0.5 * (low + high), 0, 0, -1e-5}, 1, q);
  }
  CHECK(stress.xx == Approx(s3).epsilon(1e-6));
  CHECK(-stress.yy == Approx(-s3 * kp + 2 * cohesion * std::sqrt(kp)).epsilon(1e-6));
}

TEST_CASE("yielding soil dilates by its dilation angle", "[soil]") {
  const double dilation = GENERATE(0.0, 8.0, 25.0);
  const DruckerPrager law = DruckerPrager::from_mohr_coulomb(elastic, cohesion, friction, dilation);
  DruckerPrager::History q;
  Stress stress{-50e3, -50e3, -50e3, 0};
  // Pressure builds up where dilation is hindered: a long shear leaves only what the plastic volume makes.
  for (int i = 0; i < 2000; ++i) stress = law.step(stress, Gradient{0, 5e-6, 5e-6, 0}, 1, q);
  const Stress before = stress;
  const double plastic_before = q.plastic_strain;
  stress = law.step(stress, Gradient{0, 5e-6, 5e-6, 0}, 1, q);
  const double volume = -(stress.mean() - before.mean()) / elastic.bulk_modulus;
  const double multiplier = (q.plastic_strain - plastic_before) * std::numbers::sqrt3;
  CHECK(volume == Approx(3 * law.beta * multiplier).epsilon(1e-6).margin(1e-16));
  CHECK(std::abs(law.yield(stress)) < 1e-9 * 50e3);
}

TEST_CASE("dilation ends at its limit, and the strength stays Mohr and Coulomb's", "[soil]") {
  const double limit = 0.002, p0 = 50e3;
  const auto check = [&](auto law) {
    law.dilation_limit = limit;
    typename decltype(law)::History q;
    Stress stress{-p0, -p0, -p0, 0};
    // At constant volume pressure builds up by K times the dilation.
    double before = 0;
    for (int i = 0; i < 40000; ++i) {
      before = q.dilation;
      stress = law.step(stress, Gradient{0, 5e-6, 5e-6, 0}, 1, q);
    }
    CHECK(q.dilation >= limit);
    CHECK(q.dilation < limit + 1e-5);
    CHECK(q.dilation == before);
    CHECK(-stress.mean() == Approx(p0 + elastic.bulk_modulus * q.dilation).epsilon(1e-9));
    const double pressure = -0.5 * (stress.xx + stress.yy);
    CHECK(stress.xy ==
          Approx(pressure * std::sin(friction * radians) + cohesion * std::cos(friction * radians))
              .epsilon(1e-6));
  };
  check(DruckerPrager::from_mohr_coulomb(elastic, cohesion, friction, 15));
  check(MohrCoulomb::from_angles(elastic, cohesion, friction, 15));
}

TEST_CASE("no stress is left outside the surface, its apex or the tension cut-off", "[soil]") {
  const double cut_off = 2e3;
  const DruckerPrager law = DruckerPrager::from_mohr_coulomb(elastic, cohesion, friction);
  const DruckerPrager weak = DruckerPrager::from_mohr_coulomb(elastic, cohesion, friction, 5, cut_off);
  const double apex = cohesion / std::tan(friction * radians);
  DruckerPrager::History q;
  const Stress pulled = law.step(Stress{apex, apex, apex, 0}, Gradient{1e-3, 0, 0, 1e-3}, 1, q);
  CHECK(pulled.mean() == Approx(apex).epsilon(1e-12));
  CHECK(law.yield(pulled) < 1e-9 * apex);
  for (const Stress& start :
       {Stress{8e4, -3e4, 5e4, 7e4}, Stress{-9e4, 2e4, 1e4, -5e4}, Stress{9e5, 9e5, 9e5, 0}}) {
    const Stress end = weak.step(start, Gradient(), 1, q);
    CHECK(weak.yield(end) < 1e-9 * 1e5);
    CHECK(end.mean() <= cut_off * (1 + 1e-12));
  }
  CHECK(std::isfinite(q.plastic_strain));
}

TEST_CASE("within the surface nothing differs from elasticity", "[soil]") {
  const DruckerPrager law = DruckerPrager::from_mohr_coulomb(elastic, cohesion, friction, 10);
  DruckerPrager::History q;
  const Stress old{-5e4, -8e4, -6e4, 5e3};
  const Gradient gradient(1e-5, 2e-5, -3e-5, -2e-5);
  const Stress now = law.step(old, gradient, 1, q), expected = elastic.elastic_step(old, gradient, 1);
  CHECK(now.xx == Approx(expected.xx).epsilon(1e-14));
  CHECK(now.xy == Approx(expected.xy).epsilon(1e-14));
  CHECK(q.plastic_strain == 0);
}
