#include "solver/simulation/probe.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <stdexcept>

#include "solver/kernel/cubic_spline.hpp"
#include "solver/neighbours/neighbour_list.hpp"

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

Probe::Probe(const ProbeCase& probe, const Model& model) : name_(probe.name), start_(probe.position) {
  const Particles& p = model.particles;
  const std::vector<Vec2> here = {start_};
  particles_ = find_neighbours(here, p.position, 2 * model.smoothing_length).index;
  if (particles_.empty())
    throw std::runtime_error(fmt::format("probe '{}' at ({}, {}) has no particle within {} m", name_,
                                         start_.x(), start_.y(), 2 * model.smoothing_length));
  std::vector<Vec2> near;
  std::vector<double> volumes;
  for (std::int32_t b : particles_) near.push_back(p.position[b]), volumes.push_back(p.volume(b));
  weights_ = linear_weights(start_, near, volumes, model.smoothing_length);
}

Reading Probe::read(const Particles& p) const {
  Reading r;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const std::int32_t b = particles_[i];
    r.stress = r.stress + p.stress[b] * weights_[i];
    r.pore_pressure += weights_[i] * p.pore_pressure[b];
    r.displacement += weights_[i] * p.displacement(b);
  }
  return r;
}

}  // namespace porosph
