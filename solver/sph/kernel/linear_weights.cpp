#include "solver/sph/kernel/linear_weights.hpp"

#include <Eigen/Dense>

#include "solver/sph/kernel/cubic_spline.hpp"

namespace porosph {

std::vector<double> linear_weights(const Vec2& here, const std::vector<Vec2>& near,
                                   const std::vector<double>& volumes, double smoothing_length) {
  const CubicSpline<2> kernel(smoothing_length);
  const auto basis = [&](const Vec2& p) {
    const Vec2 d = (p - here) / smoothing_length;
    return Eigen::Vector3d(1, d.x(), d.y());
  };
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  std::vector<double> weights(near.size());
  double sum = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    weights[i] = volumes[i] * kernel.value((near[i] - here).norm());
    sum += weights[i];
    moments += weights[i] * basis(near[i]) * basis(near[i]).transpose();
  }
  const bool spans_the_plane = moments.determinant() > 1e-6 * sum * sum * sum;
  const Eigen::Vector3d first = spans_the_plane
                                    ? Eigen::Vector3d(moments.ldlt().solve(Eigen::Vector3d::UnitX()))
                                    : Eigen::Vector3d(1 / sum, 0, 0);
  for (std::size_t i = 0; i < near.size(); ++i) weights[i] *= first.dot(basis(near[i]));
  return weights;
}

}  // namespace porosph
