// The same case gives the same numbers.
#include <omp.h>

#include <catch2/catch.hpp>
#include <cstring>

#include "tests/stability/scenes.hpp"

using namespace porosph;

namespace {

Particles after_steps(const Case& scene, int threads, int steps) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Simulation s(scene);
  for (int i = 0; i < steps; ++i) s.advance();
  CHECK_FALSE(s.instability());
  omp_set_num_threads(before);
  return s.model().particles;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

double largest_difference(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, (a[i] - b[i]).norm());
    size = std::max(size, a[i].norm());
  }
  return difference / size;
}

Case moving_embankment(const std::string& motion) {
  return shipped_case("verification/symmetry", {"formulation.motion=" + motion});
}

}  // namespace

TEST_CASE("the same case and threads give the same bits") {
  const Case scene = moving_embankment(GENERATE("consistent", "proposed"));
  for (const int threads : {1, 3}) {
    const Particles a = after_steps(scene, threads, 300), b = after_steps(scene, threads, 300);
    CHECK(same_bits(a.position, b.position));
    CHECK(same_bits(a.velocity, b.velocity));
    CHECK(same_bits(a.stress, b.stress));
    CHECK(same_bits(a.density, b.density));
  }
}

TEST_CASE("different thread counts agree over 1000 steps") {
  const Case scene = moving_embankment(GENERATE("consistent", "proposed", "conventional"));
  const Particles one = after_steps(scene, 1, 1000);
  for (const int threads : {2, 3}) {
    CAPTURE(threads);
    const Particles many = after_steps(scene, threads, 1000);
    CHECK(largest_difference(one.position, many.position) < 1e-10);
    CHECK(largest_difference(one.velocity, many.velocity) < 1e-10);
    CHECK(largest_stress_difference(one.stress, many.stress) < 1e-10 * largest_stress(one.stress));
  }
}
