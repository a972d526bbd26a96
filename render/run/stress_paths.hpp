// Stress paths, Mohr circles and settlement at probes, as charts.
#pragma once

#include <array>
#include <vector>

#include "render/chart.hpp"
#include "solver/space/tensor.hpp"
#include "vtk_io/finished_run/finished_run.hpp"

namespace porosph::render {

/// What engineers plot of an effective stress, compression positive. Extremes are of all three principal
/// stresses, that across the plane among them.
struct StressPoint {
  double p = 0, q = 0;  ///< mean effective stress; sqrt(3/2 s : s), the triaxial deviatoric stress
  double s = 0, t = 0;  ///< (s1 + s3) / 2, (s1 - s3) / 2: centre and radius of Mohr's largest circle
};
StressPoint stress_point(const Stress& effective);

/// Cohesion and friction of a soil at a place: t = c cos(phi) + s sin(phi).
struct Strength {
  double cohesion = 0, friction = 0;  ///< [Pa], [radians]
  bool undrained = false;             ///< of total stress: friction is 0
  bool operator==(const Strength&) const = default;
};
/// Of the soil around a point at the start: peak, then what softening leaves. Empty where there is no soil or
/// it has no strength.
std::vector<Strength> strength_at(const Case& scene, const Point& start);

enum class PathKind {
  pq,    ///< q over p', with the strength in triaxial compression and extension
  st,    ///< t over s', with the strength
  mohr,  ///< the largest circle at the end, with the stress on level planes and the strength
};

/// One chart per probe, all runs in each; without those that no run has a history of.
std::vector<Chart> stress_paths(const std::vector<FinishedRun>& runs, const std::vector<std::string>& labels,
                                PathKind kind);

/// Settlement over time, one chart per run with a line for each probe; over the logarithm of time where water
/// flows out of the soil. Empty without histories.
std::vector<Chart> settlement_curves(const std::vector<FinishedRun>& runs,
                                     const std::vector<std::string>& labels);

}  // namespace porosph::render
