// Points of the soil that several runs can be asked about: named by where they were at t = 0.
#pragma once

#include <vector>

#include "solver/analysis/sampler.hpp"
#include "vtk_io/finished_run/finished_run.hpp"

namespace porosph {

struct MaterialPoints {
  std::vector<Point> at;        ///< at t = 0 [m]
  std::vector<double> volumes;  ///< what each stands for, per metre of thickness [m2]
  bool particle_by_particle;    ///< both runs started with the same particles
  Sampler sample_a, sample_b;
};

/// The particles themselves where both runs started with the same, else the starting positions of the run
/// with fewer. Throws std::runtime_error without Displacement, or without a case where values have to be
/// interpolated.
MaterialPoints common_points(const FinishedRun& a, const Frame& frame_a, const FinishedRun& b,
                             const Frame& frame_b);

/// Why the two runs cannot be compared; empty if they can.
std::string obstacle(const FinishedRun& a, const FinishedRun& b);

}  // namespace porosph
