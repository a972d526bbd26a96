#include "app/bench/machine.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <omp.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "solver/sph/kernels/vector_units.hpp"

namespace porosph::bench {
namespace {

/// What follows "key" and a colon in a file of such lines; empty if there is no such line.
std::string entry(const char* file, const std::string& key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    const std::size_t first = line.find_first_not_of(" \t", colon + 1);
    return first == std::string::npos ? "" : line.substr(first);
  }
  return "";
}

/// An entry of /proc in kB [bytes].
std::int64_t kilobytes(const char* file, const std::string& key) {
  std::int64_t value = 0;
  std::istringstream(entry(file, key)) >> value;
  return 1024 * value;
}

}  // namespace

std::string describe_machine() {
  const std::string model = entry("/proc/cpuinfo", "model name");
  return fmt::format("{}, {} cores, vector units {}, {:.0f} GiB of memory, GCC {}",
                     model.empty() ? "unknown CPU" : model, omp_get_num_procs(),
                     vector_units_name(vector_units()),
                     static_cast<double>(kilobytes("/proc/meminfo", "MemTotal")) / (1 << 30), __VERSION__);
}

std::int64_t available_memory() { return kilobytes("/proc/meminfo", "MemAvailable"); }
std::int64_t resident_memory() { return kilobytes("/proc/self/status", "VmRSS"); }
void release_free_memory() { malloc_trim(0); }

}  // namespace porosph::bench
