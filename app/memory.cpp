#include "app/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "solver/case/demand.hpp"

namespace porosph::app {

double memory_here() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  double share = 0;
  if (std::ifstream limit("/sys/fs/cgroup/memory.max"); limit >> share) bytes = std::min(bytes, share);
  return bytes;
}

namespace {

/// What the program took so far, its libraries above all [bytes].
double memory_taken() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024;
}

}  // namespace

double memory_needed(const Case& scene) { return memory_taken() + demand_of(scene).bytes; }

void check_memory(const Case& scene) {
  const double needed = memory_needed(scene), there_is = memory_here();
  if (needed > there_is)
    throw std::runtime_error(
        fmt::format("the case needs about {:.3g} GB of memory and there is {:.3g} GB: choose a larger "
                    "particles.spacing (now {} m)",
                    needed / 1e9, there_is / 1e9, scene.particles.spacing));
}

}  // namespace porosph::app
