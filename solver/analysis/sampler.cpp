#include "solver/analysis/sampler.hpp"

#include <limits>
#include <numeric>

#include "solver/run/probe.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {

Sampler::Sampler(const std::vector<Point>& points, const std::vector<Point>& starts, double h) {
  const NeighbourList list = find_neighbours(points, starts, 2 * h);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<Point> near;
    for (std::int32_t b : list.of(i)) {
      near.push_back(starts[static_cast<std::size_t>(b)]);
      particles_.push_back(static_cast<std::size_t>(b));
    }
    if (!near.empty()) {
      const auto weights = linear_weights(points[i], near, std::vector<double>(near.size(), 1.0), h);
      weights_.insert(weights_.end(), weights.begin(), weights.end());
    }
    begin_.push_back(particles_.size());
  }
}

Sampler::Sampler(const std::vector<std::size_t>& order) : particles_(order), weights_(order.size(), 1.0) {
  begin_.resize(order.size() + 1);
  std::iota(begin_.begin(), begin_.end(), std::size_t{0});
}

std::vector<double> Sampler::operator()(const std::vector<double>& values) const {
  std::vector<double> out(begin_.size() - 1, 0.0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (begin_[i] == begin_[i + 1]) out[i] = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) out[i] += weights_[k] * values[particles_[k]];
  }
  return out;
}

}  // namespace porosph
