// Values of particles at other points.
#pragma once

#include <vector>

#include "solver/case/case.hpp"

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

}  // namespace porosph
