// Work shared among threads: particles, and sums over the body that come out the same for any number of them.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace porosph {

/// This thread's share [first, last) of n particles, inside a parallel region.
inline std::pair<std::size_t, std::size_t> thread_range(std::size_t n) {
  const auto threads = static_cast<std::size_t>(omp_get_num_threads());
  const auto me = static_cast<std::size_t>(omp_get_thread_num());
  return {n * me / threads, n * (me + 1) / threads};
}

/// Sum of term(i) over i = 0 to count - 1: blocks of fixed size on all threads, added in their order, so that
/// the bits do not depend on the number of threads. Sum is a number, or a struct that has +=.
template <class Sum = double, class Term>
Sum deterministic_sum(std::size_t count, Term&& term) {
  constexpr std::size_t block = 1024;
  std::vector<Sum> sums((count + block - 1) / block);
#pragma omp parallel for schedule(static) if (sums.size() > 1)
  for (std::size_t k = 0; k < sums.size(); ++k) {
    Sum sum{};
    for (std::size_t i = k * block; i < std::min(count, (k + 1) * block); ++i) sum += term(i);
    sums[k] = sum;
  }
  Sum all{};
  for (const Sum& sum : sums) all += sum;
  return all;
}

/// Largest of value(i) over i = 0 to count - 1, and of `least`. What is not a number counts as less.
template <class Value>
double largest_of(std::size_t count, Value&& value, double least = 0) {
  double largest = least;
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, double{value(i)});
  return largest;
}

}  // namespace porosph
