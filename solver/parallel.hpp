// Sharing of particles among threads.
#pragma once

#include <omp.h>

#include <cstddef>
#include <utility>

namespace porosph {

/// This thread's share [first, last) of n particles, inside a parallel region.
inline std::pair<std::size_t, std::size_t> thread_range(std::size_t n) {
  const auto threads = static_cast<std::size_t>(omp_get_num_threads());
  const auto me = static_cast<std::size_t>(omp_get_thread_num());
  return {n * me / threads, n * (me + 1) / threads};
}

}  // namespace porosph
