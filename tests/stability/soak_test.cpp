// What rests must stay at rest.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/stability/scenes.hpp"

using namespace porosph;

namespace {

struct Rest {
  double settlement = 0, energy = 0;
  std::vector<Stress> stress;
};

Rest rest_of(Simulation& s) { return {settlement(s), s.energy().elastic, s.model().particles.stress}; }

/// At the time of release and `steps` later nothing may differ by more than `allowed`.
void rests(const Case& scene, std::int64_t steps, double allowed) {
  Simulation s(scene);
  while (s.time() < scene.loading.damping_until) s.advance();
  const Rest before = rest_of(s);
  for (std::int64_t i = 0; i < steps; ++i) s.advance();
  REQUIRE_FALSE(s.instability());
  const Rest after = rest_of(s);
  CHECK(after.settlement == Approx(before.settlement).epsilon(allowed));
  CHECK(after.energy == Approx(before.energy).epsilon(allowed));
  CHECK(largest_stress_difference(after.stress, before.stress) < allowed * largest_stress(before.stress));
  CHECK(s.energy().kinetic < allowed * before.energy);
}

Case disordered_bed(double end) {
  Case scene = saturated_bed(end);
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = 0.3;
  return scene;
}

Case released_embankment(double end) {
  return shipped_case("embankment", {"particles.spacing=0.5", "time.courant=0.9", "loading.damping=0.03",
                                     "loading.damping_until=12", "time.end=" + std::to_string(end)});
}

}  // namespace

TEST_CASE("a resting saturated bed does not drift without damping") {
  rests(saturated_bed(1e3), 30000, 1e-3);
}

TEST_CASE("a resting bed of disordered particles does not drift without damping") {
  rests(disordered_bed(1e3), 10000, 1e-3);
}

TEST_CASE("a resting saturated bed does not drift in a million steps", "[.nightly]") {
  rests(saturated_bed(1e4), 1000000, 1e-3);
}

TEST_CASE("a resting bed of disordered particles does not drift in a million steps", "[.nightly]") {
  rests(disordered_bed(1e4), 1000000, 1e-3);
}

TEST_CASE("an embankment released from damping stays in equilibrium") {
  rests(released_embankment(100), 2000, 1e-3);
}

TEST_CASE("an embankment released from damping stays in equilibrium for long", "[.nightly]") {
  rests(released_embankment(1000), 100000, 1e-3);
}

TEST_CASE("a hundred slow wetting and draining cycles return to the start") {
  constexpr int cycles = 100;
  constexpr double period = 2;  // of a cycle [s]; the slowest vibration has 0.08 s
  Case scene = saturated_bed(1 + cycles * period);
  scene.loading.damping_until = never;
  scene.water.level_over_time = {{0, 3}, {1, 3}};
  for (int i = 0; i < cycles; ++i) {
    scene.water.level_over_time.emplace_back(1 + (i + 0.5) * period, 0);
    scene.water.level_over_time.emplace_back(1 + (i + 1.0) * period, 3);
  }
  Simulation s(scene);
  const auto go_to = [&](double time) {
    while (s.time() < time && !s.instability()) s.advance();
    REQUIRE_FALSE(s.instability());
  };
  go_to(1);
  const Rest before = rest_of(s);
  go_to(1 + 0.5 * period);
  CHECK(settlement(s) > 1.5 * before.settlement);  // the soil has lost its buoyancy
  go_to(1 + cycles * period);
  const Rest after = rest_of(s);
  CHECK(after.settlement == Approx(before.settlement).epsilon(5e-3));
  CHECK(after.energy == Approx(before.energy).epsilon(5e-3));
  CHECK(largest_stress_difference(after.stress, before.stress) < 5e-3 * largest_stress(before.stress));
}
