// Consolidation with a permeability that follows the pores.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/reference/exact/consolidation.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double load = 60e3, modulus = 12e6, height = 4, porosity = 0.1, c_v = 1e-9 * modulus / 9810;

/// k over its value at the start, by the porosity that a small compression leaves: written out a second time, for the test.
double permeability(double compression) {
  const double n = 1 - (1 - porosity) / (1 - compression);
  return std::pow(n, 3) / std::pow(1 - n, 2) / (std::pow(porosity, 3) / std::pow(1 - porosity, 2));
}

/// Excess pressure over the load in cells from the base to the drained top, under
/// du/dt = c_v d/dy (k/k0 du/dy) with the compression (1 - u) load / M: finite volumes, and implicit steps
/// that take k from the step before.
class Column {
 public:
  explicit Column(std::size_t cells) : u_(cells, 1.0), dy_(height / static_cast<double>(cells)) {}

  void advance(double until) {
    while (time_ < until) {
      const double dt = std::min(until - time_, std::max(1e-3 * time_, 100.0));
      step(dt), time_ += dt;
    }
  }
  double at(double y) const {
    const double place = y / dy_ - 0.5;
    const std::size_t i = std::min(static_cast<std::size_t>(std::max(place, 0.0)), u_.size() - 2);
    return u_[i] + (place - static_cast<double>(i)) * (u_[i + 1] - u_[i]);
  }
  double degree() const {
    double sum = 0;
    for (const double u : u_) sum += 1 - u;
    return sum / static_cast<double>(u_.size());
  }

 private:
  double k(double u) const { return permeability((1 - u) * load / modulus); }
  /// Thomas's algorithm.
  void step(double dt) {
    const std::size_t n = u_.size();
    const double r = dt * c_v / (dy_ * dy_);
    std::vector<double> up(n), diagonal(n, 1), right = u_;
    for (std::size_t i = 0; i < n; ++i) {
      up[i] = i + 1 < n ? r * (k(u_[i]) + k(u_[i + 1])) / 2 : 2 * r * k(0);
      diagonal[i] += up[i] + (i > 0 ? up[i - 1] : 0);
    }
    for (std::size_t i = 1; i < n; ++i) {
      const double w = up[i - 1] / diagonal[i - 1];
      diagonal[i] -= w * up[i - 1], right[i] += w * right[i - 1];
    }
    u_[n - 1] = right[n - 1] / diagonal[n - 1];
    for (std::size_t i = n - 1; i-- > 0;) u_[i] = (right[i] + up[i] * u_[i + 1]) / diagonal[i];
  }

  std::vector<double> u_;
  double dy_, time_ = 0;
};

}  // namespace

TEST_CASE("consolidation: permeability by Kozeny and Carman") {
  Column column(800);
  Simulation s(scene("kozeny_carman"));
  const auto measure = [&](Simulation& now) {
    if (now.time() == 0) return;
    column.advance(now.time());
    const Particles& p = now.model().particles;
    double off = 0, off_constant = 0, size = 0;
    const double factor = now.time() * c_v / (height * height);
    for (std::size_t a = 0; a < p.size(); ++a) {
      const double found = 9810 * now.consolidation()->head()[a] / load, y = p.start[a].y();
      off += std::pow(found - column.at(y), 2), size += std::pow(column.at(y), 2);
      off_constant += std::pow(found - terzaghi_pressure(1 - y / height, factor), 2);
    }
    CAPTURE(factor, std::sqrt(off_constant / size));
    CHECK(std::sqrt(off_constant / size) > 0.02);  // what a permeability that stays would give
    expect({.name = "kozeny_carman",
            .settings = {},
            .quantity = fmt::format("excess pore pressure at T = {:.3g}, relative L2", factor),
            .reference = "integration in one dimension",
            .resolution = metres(0.2)},
           std::sqrt(off / size), 0.005);
  };
  run_to_end(s, {.frame = measure, .history = {}, .progress = {}, .interrupted = {}});
  CHECK(std::abs(s.consolidation()->imbalance()) < 1e-8 * s.consolidation()->drained());
}
