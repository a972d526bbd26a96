#include "solver/analysis/surface_profile.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

using namespace porosph;

namespace {

/// Squares of `side` that fill [0, 4] x [0, 1] and [2, 4] x [1, 2], shifted by dx.
Frame stairs(double side, double dx) {
  Frame frame;
  std::vector<double> mass;
  const int n = static_cast<int>(std::lround(4 / side));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < (i < n / 2 ? n / 4 : n / 2); ++j) {
      frame.points.insert(frame.points.end(), {dx + (i + 0.5) * side, (j + 0.5) * side, 0});
      mass.push_back(2000 * side * side);
    }
  frame.fields.push_back({"Mass", {}, mass});
  frame.fields.push_back({"Density", {}, std::vector<double>(mass.size(), 2000)});
  return frame;
}

}  // namespace

TEST_CASE("the profile of soil has its steps, its area and its quantiles", "[profile]") {
  const double side = GENERATE(0.25, 0.125), dx = GENERATE(0.0, 1.0, -10.0), width = GENERATE(0.125, 0.25);
  CAPTURE(side, dx, width);
  const SurfaceProfile p = surface_profile(stairs(side, dx), width);
  CHECK(p.area == Approx(6));
  CHECK(p.mean_x == Approx(dx + (2 * 1 + 4 * 3) / 6.0));
  CHECK(p.quantile95 == Approx(dx + 4 - 0.05 * 6 / 2).margin(0.51 * side));
  CHECK(p.quantile99 == Approx(dx + 4 - 0.01 * 6 / 2).margin(0.51 * side));
  CHECK(std::accumulate(p.thickness.begin(), p.thickness.end(), 0.0) * width == Approx(6));
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    const double step = p.x[k] - dx < 2 ? 1 : 2;
    CHECK(p.thickness[k] == Approx(step));
    CHECK(p.surface[k] == Approx(step));
  }
}

TEST_CASE("a profile of nothing is an error", "[profile]") {
  CHECK_THROWS_AS(surface_profile(Frame(), 0.1), std::runtime_error);
}
