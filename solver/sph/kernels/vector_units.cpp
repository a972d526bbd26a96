#include "solver/sph/kernels/vector_units.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

namespace porosph {
namespace {

// The same units as the flags in cmake/PorosphDispatch.cmake.
#ifdef POROSPH_CPU_LEVELS
bool has_avx2() { return __builtin_cpu_supports("x86-64-v3") != 0; }
bool has_avx512() { return __builtin_cpu_supports("x86-64-v4") != 0; }
#elif defined POROSPH_DISPATCH
bool has_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2");
}
bool has_avx512() {
  return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
}
#endif

bool processor_has(VectorUnits units) {
#ifdef POROSPH_DISPATCH
  if (units == VectorUnits::avx512) return has_avx512();
  if (units == VectorUnits::avx2) return has_avx2();
#endif
  return units == VectorUnits::portable;
}

VectorUnits choose() {
  const std::vector<VectorUnits> units = all_vector_units();
  const char* wanted = std::getenv("POROSPH_VECTOR_UNITS");
  if (wanted == nullptr) return units.front();
  std::vector<std::string_view> names;
  for (const VectorUnits u : units) {
    if (vector_units_name(u) == wanted) return u;
    names.push_back(vector_units_name(u));
  }
  throw std::runtime_error(
      fmt::format("environment variable POROSPH_VECTOR_UNITS = {}: must be one of {} here", wanted,
                  fmt::join(names, ", ")));
}

}  // namespace

VectorUnits vector_units() {
  static const VectorUnits units = choose();
  return units;
}

std::vector<VectorUnits> all_vector_units() {
  std::vector<VectorUnits> units;
  for (const VectorUnits u : {VectorUnits::avx512, VectorUnits::avx2, VectorUnits::portable})
    if (processor_has(u)) units.push_back(u);
  return units;
}

std::string_view vector_units_name(VectorUnits units) {
  switch (units) {
    case VectorUnits::avx512:
      return "avx512";
    case VectorUnits::avx2:
      return "avx2";
    case VectorUnits::portable:
      break;
  }
  return "portable";
}

}  // namespace porosph
