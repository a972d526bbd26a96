#include "app/bench/roofline.hpp"

#include <omp.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "app/bench/clock.hpp"

namespace porosph::bench {
namespace {

constexpr int width = 8;  // doubles of the widest vector
using Vector =
    double __attribute__((vector_size(width * sizeof(double)), aligned(sizeof(double)), may_alias));

// One binary for all machines: the compiler makes a version of these functions for each vector unit.
#ifdef __clang__  // which knows no `noinline` beside it
#define FOR_EVERY_VECTOR_UNIT __attribute__((target_clones("avx512f", "arch=haswell", "default")))
#else
#define FOR_EVERY_VECTOR_UNIT __attribute__((noinline, target_clones("avx512f", "arch=haswell", "default")))
#endif

/// Sum of `count` numbers, count a multiple of 64: eight sums at a time, as an addition takes its time.
FOR_EVERY_VECTOR_UNIT double sum_of(const double* numbers, std::size_t count) {
  const auto* data = reinterpret_cast<const Vector*>(numbers);
  Vector sum[8] = {};
  for (std::size_t i = 0; i < count / width; i += 8)
    for (std::size_t k = 0; k < 8; ++k) sum[k] += data[i + k];
  for (const Vector& s : sum) sum[0] += s;
  return sum[0][0];
}

constexpr std::int64_t chains = 8;  // multiply-adds under way at a time

FOR_EVERY_VECTOR_UNIT double multiply_and_add(std::int64_t times, double factor, double added,
                                              const double* start) {
  Vector x[chains];  // unlike each other, or the compiler makes one of them
  for (int k = 0; k < chains; ++k) x[k] = reinterpret_cast<const Vector*>(start)[k];
  for (std::int64_t i = 0; i < times; ++i)
    for (Vector& v : x) v = v * factor + added;
  for (const Vector& v : x) x[0] += v;
  return x[0][0];
}

volatile double sink;  // what is read by nobody is not computed

}  // namespace

double read_rate(std::size_t bytes, int threads, double seconds) {
  constexpr std::size_t block = 8 * width;  // numbers
  const std::size_t share = std::max<std::size_t>(1, bytes / sizeof(double) / block / threads) * block;
  const auto share_bytes = static_cast<double>(share * sizeof(double));
  const int sweeps = static_cast<int>(std::clamp(1e6 / share_bytes, 1.0, 1000.0));
  double rate = 0;
#pragma omp parallel num_threads(threads) reduction(+ : rate)
  {
    const std::vector<double> data(share, 1.0);
    double best = 0, sum = 0;
    for (const double start = now().wall; best == 0 || now().wall - start < seconds;) {
      const Seconds t = timed([&] {
        for (int i = 0; i < sweeps; ++i) sum += sum_of(data.data(), share);
      });
      best = std::max(best, sweeps * share_bytes / t.of(threads));
    }
    rate += best;
    sink = sum;
  }
  return rate;
}

double arithmetic_rate(double seconds) {
  constexpr std::int64_t times = 200'000;
  constexpr double operations = 2.0 * width * chains * times;
  std::vector<double> start(width * chains);
  std::iota(start.begin(), start.end(), 1.0);
  double best = 0;
  for (const double begin = now().wall; best == 0 || now().wall - begin < seconds;)
    best = std::max(
        best, operations / timed([&] { sink = multiply_and_add(times, 0.999999, 1e-6, start.data()); }).cpu);
  return best;
}

}  // namespace porosph::bench
