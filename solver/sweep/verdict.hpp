// How a run of a sweep ended.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "solver/simulation/simulation.hpp"
#include "solver/sweep/sweep.hpp"

namespace porosph {

enum class StabilityClass {
  accurate,     ///< at rest, with an error below the limit
  inaccurate,   ///< at rest at another stress
  not_settled,  ///< still moving at the end
  unstable,     ///< broke down
  thrown_out,   ///< particles left the soil body
  refused,      ///< no valid case
};
inline constexpr int stability_classes = 6;

std::string_view class_name(StabilityClass c);  ///< "not settled"

struct Verdict {
  StabilityClass outcome = StabilityClass::refused;
  std::string cause;         ///< of the breakdown, one or two words; else empty
  double time = 0;           ///< of the breakdown or the end [s]
  std::int64_t steps = 0;    ///< until then
  double error = 0;          ///< relative L2 of the vertical effective stress; NaN where there is none
  double unbalanced = 0;     ///< unbalanced force ratio at the end; NaN after a breakdown
  double energy_growth = 0;  ///< as in Summary
  std::string message;       ///< of the breakdown or the refusal
};

/// Relative L2 error of a state at rest.
using ErrorMeasure = std::function<double(const Simulation&)>;
/// The measure for a case. May throw std::runtime_error where the case has no such reference.
using MeasureMaker = std::function<ErrorMeasure(const Case&)>;

/// Against the exact solution that the case names.
ErrorMeasure exact_measure(const Case& scene);
/// Against the weight above, which is exact for level ground and layers at small strain.
ErrorMeasure weight_measure(const Case& scene);
/// Of stress `exact(start)` [Pa] at the particles' positions at t = 0; where it is not finite the particle
/// does not count.
double vertical_stress_error(const Simulation& simulation, const std::function<double(const Vec2&)>& exact);

/// Runs the case to its end, equilibrium or breakdown, on the calling thread alone.
Verdict judge(const Case& scene, const SweepLimits& limits, const MeasureMaker& measure,
              const std::function<bool()>& interrupted);

}  // namespace porosph
