#include "app/bench/roofline.hpp"

#include <omp.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "app/bench/clock.hpp"

namespace porosph::bench {
namespace {

constexpr int width = 8;  // doubles of the widest vector
using Vector = double __attribute__((vector_size(width * sizeof(double))));

// One binary for all machines: the compiler makes a version of these functions for each vector unit. Results
// go through memory, as vectors have no portable way through a call.
#define FOR_EVERY_VECTOR_UNIT __attribute__((noinline, target_clones("avx512f", "arch=haswell", "default")))

/// Sum of `count` vectors, count a multiple of 8: eight sums at a time, as an addition takes its time.
FOR_EVERY_VECTOR_UNIT void sum_up(const Vector* data, std::size_t count, Vector* result) {
  Vector sum[8] = {};
  for (std::size_t i = 0; i < count; i += 8)
    for (std::size_t k = 0; k < 8; ++k) sum[k] += data[i + k];
  for (const Vector& s : sum) *result += s;
}

constexpr std::int64_t chains = 8;  // multiply-adds under way at a time

FOR_EVERY_VECTOR_UNIT void multiply_and_add(std::int64_t times, Vector* state) {
  Vector x[chains];
  for (int k = 0; k < chains; ++k) x[k] = state[k];
  const Vector factor = state[0] * 0 + 0.999999, added = state[0] * 0 + 1e-6;
  for (std::int64_t i = 0; i < times; ++i)
    for (int k = 0; k < chains; ++k) x[k] = x[k] * factor + added;
  for (int k = 0; k < chains; ++k) state[k] = x[k];
}

volatile double sink;  // what is read by nobody is not computed

}  // namespace

double read_rate(std::size_t bytes, int threads, double seconds) {
  constexpr std::size_t block = 8 * sizeof(Vector);
  const std::size_t share = std::max<std::size_t>(1, bytes / block / threads) * 8;  // vectors of each thread
  double rate = 0;
#pragma omp parallel num_threads(threads) reduction(+ : rate)
  {
    const std::vector<Vector> data(share, Vector{} + 1.0);
    Vector result{};
    const auto sweep = [&] { sum_up(data.data(), share, &result); };
    sweep();
#pragma omp barrier
    double best = 0;
    for (const double start = now().wall; now().wall - start < seconds;) {
      const int sweeps =
          static_cast<int>(std::clamp<std::size_t>(1'000'000 / (share * sizeof(Vector)), 1, 1000));
      const Seconds t = timed([&] {
        for (int i = 0; i < sweeps; ++i) sweep();
      });
      best = std::max(
          best, static_cast<double>(sweeps) * static_cast<double>(share * sizeof(Vector)) / t.of(threads));
    }
    rate += best;
    sink = result[0];
  }
  return rate;
}

double arithmetic_rate(double seconds) {
  constexpr std::int64_t times = 200'000;
  std::vector<Vector> state(chains, Vector{} + 1.0);
  double best = 0;
  for (const double start = now().wall; now().wall - start < seconds;)
    best = std::max(best,
                    2.0 * width * chains * times / timed([&] { multiply_and_add(times, state.data()); }).cpu);
  sink = state[0][0];
  return best;
}

}  // namespace porosph::bench
