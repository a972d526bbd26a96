// Seepage over time in soil that is saturated in part.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

/// Srivastava and Yeh 1991, eq. (10) onwards: psi in a column above its water table, after the rain has
/// changed from `before` to `after`, over the saturated permeability. z and L times alpha, t times alpha Ks /
/// (theta_s - theta_r); psi0 = 0 at the bottom. Times alpha.
class SrivastavaYeh {
 public:
  SrivastavaYeh(double length, double before, double after)
      : length_(length), before_(before), after_(after) {
    const auto f = [&](double l) { return std::sin(l * length) + 2 * l * std::cos(l * length); };
    for (int n = 0; n < 300; ++n) {  // one root between poles of tan(l L) = -2 l
      double low = (n + 0.5) * std::numbers::pi / length, high = (n + 1) * std::numbers::pi / length;
      const bool rises = f(low) < 0;
      for (int i = 0; i < 100; ++i) ((f((low + high) / 2) < 0) == rises ? low : high) = (low + high) / 2;
      roots_.push_back((low + high) / 2);
    }
  }
  double psi(double z, double t) const {
    double sum = 0;
    for (const double l : roots_)
      sum += std::sin(l * z) * std::sin(l * length_) * std::exp(-l * l * t) /
             (1 + length_ / 2 + 2 * l * l * length_);
    const double k = after_ - (after_ - 1) * std::exp(-z) -
                     4 * (after_ - before_) * std::exp((length_ - z) / 2) * std::exp(-t / 4) * sum;
    return std::log(k);
  }

 private:
  double length_, before_, after_;
  std::vector<double> roots_;
};

/// Relative L2 of the pressure head against the exact one at the times of the output.
std::vector<std::pair<double, double>> errors_of_infiltration(Simulation& s) {
  constexpr double alpha = 10, ks = 2.777777777778e-6, free = 0.34;
  const SrivastavaYeh exact(alpha, 0.1, 0.9);
  std::vector<std::pair<double, double>> errors;
  run_to_end(s, {.frame =
                     [&](Simulation& now) {
                       double error = 0, size = 0;
                       const Particles& p = now.model().particles;
                       const auto head = now.seepage()->richards().head();
                       for (std::size_t a = 0; a < p.size(); ++a) {
                         const double y = p.start[a].y();
                         const double psi =
                             exact.psi(alpha * y, alpha * ks * std::max(now.time(), 1e-9) / free) / alpha;
                         error += std::pow(head[a] - y - psi, 2), size += psi * psi;
                       }
                       errors.emplace_back(now.time(), std::sqrt(error / size));
                     },
                 .history = {},
                 .progress = {},
                 .interrupted = {}});
  return errors;
}

}  // namespace

TEST_CASE("infiltration: Srivastava and Yeh's series gives the values that others printed") {
  const SrivastavaYeh exact(10, 0.1, 0.9);  // psi in cm, alpha = 0.1 / cm, t = 0.1 / 0.34 per hour
  CHECK(10 * exact.psi(5, 10 * 0.1 / 0.34) == Approx(-14.19).margin(0.005));
  CHECK(10 * exact.psi(10, 1 * 0.1 / 0.34) == Approx(-7.26).margin(0.005));
  CHECK(10 * exact.psi(2, 50 * 0.1 / 0.34) == Approx(-1.435).margin(0.0005));
}

TEST_CASE("infiltration: rain above a water table") {
  for (const double spacing : {0.04, 0.02}) {
    const Settings settings =
        spacing == 0.02 ? Settings{} : Settings{fmt::format("particles.spacing={:g}", spacing)};
    Simulation s(scene("infiltration", settings));
    const auto errors = errors_of_infiltration(s);
    REQUIRE(errors.size() == 5);
    for (const auto& [time, error] : errors)
      expect({.name = "infiltration",
              .settings = settings,
              .quantity = fmt::format("pressure head after {:g} h, relative L2", time / 3600),
              .reference = "Srivastava and Yeh 1991",
              .resolution = metres(spacing)},
             error, spacing == 0.02 ? 0.006 : 0.012);
    const Richards::Balance balance = s.seepage()->richards().balance();
    expect({.name = "infiltration",
            .settings = settings,
            .quantity = "balance of the water, over what entered and left",
            .reference = "conservation",
            .resolution = metres(spacing)},
           std::abs(balance.error()), 1e-8, scientific);
  }
}

TEST_CASE("infiltration: rain ponds, and then enters as a sharp front takes it") {
  // F - psi_f dtheta ln(1 + F / (psi_f dtheta)) = K (t - t_p + t_0) after ponding at t_p, when F = R t_p.
  constexpr double k = 1e-6, rain = 4e-6, store = 0.2 * 0.3;
  const double ponds = k * store / (rain * (rain - k));
  const auto time_of = [&](double f) { return (f - store * std::log1p(f / store)) / k; };
  const double shift = ponds - time_of(rain * ponds);
  const auto infiltrated = [&](double time) {
    if (time <= ponds) return rain * time;
    double low = 0, high = rain * time;
    for (int i = 0; i < 100; ++i) (time_of((low + high) / 2) < time - shift ? low : high) = (low + high) / 2;
    return low;
  };
  Simulation s(scene("ponding"));
  double worst = 0;
  run_to_end(s, {.frame =
                     [&](Simulation& now) {
                       if (now.time() == 0) return;
                       const double found = now.seepage()->richards().balance().entered / 0.04;
                       worst = std::max(worst, std::abs(found / infiltrated(now.time()) - 1));
                     },
                 .history = {},
                 .progress = {},
                 .interrupted = {}});
  expect({.name = "ponding",
          .settings = {},
          .quantity = "water that has entered, largest error from the first hour on",
          .reference = "Green and Ampt 1911, ponding at 5000 s",
          .resolution = metres(0.01)},
         worst, 0.05);
  CHECK(std::abs(s.seepage()->richards().balance().error()) < 1e-8);
}
