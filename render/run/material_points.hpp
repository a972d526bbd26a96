// Points of the soil that several runs can be asked about: named by where they were at t = 0.
#pragma once

#include <cstdint>
#include <vector>

#include "render/run/finished_run.hpp"

namespace porosph {

/// Takes values of particles to values at points, exactly where they are linear in the starting position.
class Sampler {
 public:
  /// Moving least squares over the particles that started within twice the run's smoothing length of a point.
  /// A point without any reads NaN.
  Sampler(const std::vector<Point>& points, const std::vector<Point>& starts, double smoothing_length);
  /// Point i is particle order[i] itself.
  explicit Sampler(const std::vector<std::size_t>& order);

  std::vector<double> operator()(const std::vector<double>& particle_values) const;

 private:
  std::vector<std::size_t> begin_ = {0}, particles_;
  std::vector<double> weights_;
};

struct MaterialPoints {
  std::vector<Point> at;        ///< at t = 0 [m]
  std::vector<double> volumes;  ///< what each stands for, per metre of thickness [m2]
  bool particle_by_particle;    ///< both runs started with the same particles
  Sampler sample_a, sample_b;
};

/// Where the particles were at t = 0. Throws std::runtime_error if the frame has no Displacement.
std::vector<Point> starts_of(const Frame& frame);

/// Mass / Density, or all equal where the frame lacks them [m2].
std::vector<double> volumes_of(const Frame& frame);

/// The particles themselves where both runs started with the same, else the starting positions of the run
/// with fewer. Throws std::runtime_error without Displacement, or without a case where values have to be
/// interpolated.
MaterialPoints common_points(const FinishedRun& a, const Frame& frame_a, const FinishedRun& b,
                             const Frame& frame_b);

/// Why the two runs cannot be compared; empty if they can.
std::string obstacle(const FinishedRun& a, const FinishedRun& b);

}  // namespace porosph
