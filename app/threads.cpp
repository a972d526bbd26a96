#include "app/threads.hpp"

#include <omp.h>

#include <algorithm>

namespace porosph::app {
namespace {

/// More threads than this would wait for each other.
int useful_threads(std::size_t particles) {
  constexpr std::size_t particles_per_thread = 4000;
  return std::clamp(static_cast<int>(particles / particles_per_thread), 1, omp_get_num_procs());
}

}  // namespace

void use_threads(int wanted, std::size_t particles) {
  omp_set_num_threads(wanted > 0 ? wanted : useful_threads(particles));
}

}  // namespace porosph::app
