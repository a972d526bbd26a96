// What error a second of run time buys: every form, spacing and strategy that the time allows.
#pragma once

#include "app/bench/bench.hpp"
#include "app/bench/statistics.hpp"
#include "render/report/study.hpp"

namespace porosph::bench {

/// A scene, how it is computed, and what came out. Times are of one core.
struct WorkPoint {
  std::string scene, form, strategy;
  double spacing = 0;  ///< of particles; edge of finite elements [m]
  std::int64_t particles = 0, steps = 0;
  std::string ending;
  double error = 0;     ///< of sigma'_yy at the end, relative L2
  Spread seconds = {};  ///< until the run ended
  Spread settled = {};  ///< until its error was within 5 % of the last one, and stayed there

  /// What counts: the whole run where it ends by itself at equilibrium, else until the error has settled.
  const Spread& work() const { return ending == "equilibrium" ? seconds : settled; }
};

struct WorkPrecision {
  std::vector<WorkPoint> points;

  /// Null where it was not measured.
  const WorkPoint* find(const std::string& scene, const std::string& form, const std::string& strategy,
                        double spacing) const;
};

inline const std::string plain_form = "plain loops", consistent_form = "consistent",
                         fem_form = "finite elements";
inline const std::string paper_strategy = "C = 0.2, ξ = 0.002", rest_strategy = "large step, stop at rest",
                         refresh_strategy = "large step, geometry every step", fast_strategy = "fast case";

WorkPrecision measure_work_precision(Bench& bench);

/// Writes work_precision.csv, work_precision.png.
render::StudySection show_work_precision(const WorkPrecision& work, const Bench& bench);

}  // namespace porosph::bench
