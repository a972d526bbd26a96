// Scenes that the stability tests share.
#pragma once

#include <omp.h>

#include <string>
#include <vector>

#include "solver/case/case_file.hpp"
#include "solver/run/simulation.hpp"

namespace porosph {

/// These scenes are too small to share between threads.
inline const bool one_thread = (omp_set_num_threads(1), true);

/// cases/<name>.toml with overrides.
inline Case shipped_case(const std::string& name, const std::vector<std::string>& settings = {}) {
  return read_case(std::string(POROSPH_SOURCE_DIR) + "/cases/" + name + ".toml", settings);
}

/// A saturated bed of 10 x 10 particles between rollers, brought to rest in one second and then left alone.
inline Case saturated_bed(double end) {
  return shipped_case(
      "verification/column",
      {"particles.spacing=0.2", "soil.soil.polygon=[[0,0],[2,0],[2,2],[0,2]]", "water.level=3",
       "boundary=[{kind='roller',from=[0,0],to=[0,3]},{kind='roller',from=[2,0],to=[2,3]},"
       "{kind='fixed',from=[0,0],to=[2,0]}]",
       "loading.damping=0.3", "loading.damping_until=1", "stop.unbalanced_force_ratio=0",
       "time.end=" + std::to_string(end)});
}

inline double settlement(const Simulation& s) {
  double lowest = 0;
  for (std::size_t i = 0; i < s.model().particles.size(); ++i)
    lowest = std::min(lowest, s.model().particles.displacement(i).y());
  return -lowest;
}

inline double largest_stress_difference(const std::vector<Stress>& a, const std::vector<Stress>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Stress d = a[i] + b[i] * -1;
    for (const double x : {d.xx, d.yy, d.zz, d.xy}) largest = std::max(largest, std::abs(x));
  }
  return largest;
}

inline double largest_stress(const std::vector<Stress>& a) {
  return largest_stress_difference(a, std::vector<Stress>(a.size()));
}

}  // namespace porosph
