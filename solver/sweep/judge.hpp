// Runs a case of a sweep and says how it ended.
#pragma once

#include <functional>

#include "solver/run/simulation.hpp"
#include "solver/sweep/sweep.hpp"
#include "solver/sweep/verdict.hpp"

namespace porosph {

/// Relative L2 error of a state at rest, or what stands for it.
using ErrorMeasure = std::function<double(Simulation&)>;
/// The measure for a case. May throw std::runtime_error where the case has no such reference.
using MeasureMaker = std::function<ErrorMeasure(const Case&)>;

/// Against the exact solution that the case names.
ErrorMeasure exact_measure(const Case& scene);
/// Against the weight above, which is exact for level ground and layers at small strain.
ErrorMeasure weight_measure(const Case& scene);
/// What of the energy released the zero-energy control, viscosity, the diffusion of stress and the
/// integration took: of soil that flows without damping.
ErrorMeasure energy_measure(const Case& scene);
/// Of stress `exact(start)` [Pa] at the particles' positions at t = 0; where it is not finite the particle
/// does not count.
double vertical_stress_error(const Simulation& simulation, const std::function<double(const Vec2&)>& exact);

/// Runs the case to its end, equilibrium or breakdown, on the calling thread alone.
Verdict judge(const Case& scene, const SweepLimits& limits, const MeasureMaker& measure,
              const std::function<bool()>& interrupted);

}  // namespace porosph
