#include "solver/sph/paper/tension_control.hpp"

#include <cmath>

#include "solver/sph/stabilisation/artificial_stress.hpp"

namespace porosph {

TensionControl::TensionControl(const Model& model, double strength)
    : strength_(strength),
      kernel_(model.smoothing_length),
      at_spacing_(kernel_.value(model.spacing)),
      exponent_(kernel_.value(0) / at_spacing_) {}

void TensionControl::take_stress(const Particles& p, const Ghosts& ghosts) {
  active_ = false;
  if (strength_ == 0) return;
  values_.resize(p.size() + ghosts.size());
  bool any = false;
#pragma omp parallel for schedule(static) reduction(|| : any)
  for (std::size_t a = 0; a < p.size(); ++a) {
    values_[a] = artificial_stress(p.stress[a], p.density[a], strength_);
    any = any || !values_[a].isZero(0);
  }
  active_ = any;
  ghosts.fill<Mirrors::tensor>(
      [&](std::size_t k) {
        const Eigen::Vector3d& r = values_[k];
        return (Mat2() << r[0], r[2], r[2], r[1]).finished();
      },
      [&](std::size_t k, const Mat2& m) {
        values_[k] = {m(0, 0), m(1, 1), m(0, 1)};
      });
}

double TensionControl::factor(double distance) const {
  return std::pow(kernel_.value(distance) / at_spacing_, exponent_);
}

}  // namespace porosph
