// A scene that is its own mirror image stays so.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/sph/neighbours/neighbour_list.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double middle = 10;
Vec2 mirrored(const Vec2& x) { return {2 * middle - x.x(), x.y()}; }

/// The particle that starts where each one's mirror image does.
std::vector<std::size_t> partners(const Particles& p) {
  std::vector<std::size_t> partner;
  for (const Vec2& start : p.start) {
    const Vec2 image = mirrored(start);
    std::size_t best = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      if ((p.start[i] - image).squaredNorm() < (p.start[best] - image).squaredNorm()) best = i;
    REQUIRE((p.start[best] - image).norm() < 1e-9);
    partner.push_back(best);
  }
  return partner;
}

/// The largest difference between stresses and their mirror images, over the largest stress.
double asymmetry(const Particles& p, const std::vector<std::size_t>& partner) {
  double difference = 0, largest = 0, path = 0, paths = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Stress &s = p.stress[i], &t = p.stress[partner[i]];
    difference = std::max({difference, std::abs(s.xx - t.xx), std::abs(s.yy - t.yy), std::abs(s.zz - t.zz),
                           std::abs(s.xy + t.xy)});
    largest = std::max(largest, std::abs(s.yy));
    path = std::max(path, (mirrored(p.position[i]) - p.position[partner[i]]).norm());
    paths = std::max(paths, p.displacement(i).norm());
  }
  return std::max(difference / largest, path / paths);
}

}  // namespace

TEST_CASE("symmetry: a symmetric embankment stays symmetric") {
  for (const Settings& settings : {Settings{}, Settings{"formulation.motion=proposed"}}) {
    Simulation s(scene("symmetry", settings));
    const auto partner = partners(s.model().particles);
    run_to_end(s);
    CHECK(s.step() > 300);
    expect({"symmetry", settings,
            "stress and displacement against their mirror images, undamped, " +
                std::string(motion_name(s.scene().formulation.motion)) + " form",
            "mirror symmetry", metres(0.5)},
           asymmetry(s.model().particles, partner), 1e-11, scientific);
  }
}
