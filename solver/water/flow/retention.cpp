#include "solver/water/flow/retention.hpp"

#include <algorithm>
#include <cmath>

namespace porosph {
namespace {

constexpr double dry = 1e-3;  // kr of the saturated model above the water table

struct Curve {
  double value, slope;
};

/// Se and dSe/dpsi of van Genuchten, psi < 0.
Curve van_genuchten(const RetentionCase& soil, double psi) {
  const double m = 1 - 1 / soil.n, suction = -soil.alpha * psi, power = std::pow(suction, soil.n);
  const double se = std::pow(1 + power, -m);
  return {se, m * soil.n * soil.alpha * power / suction * se / (1 + power)};
}

/// Mualem 1976 in the closed form of van Genuchten, eq. (8).
Retention::Permeability mualem(const RetentionCase& soil, double psi) {
  const double m = 1 - 1 / soil.n;
  const Curve se = van_genuchten(soil, psi);
  const double t = std::pow(se.value, 1 / m), open = 1 - std::pow(1 - t, m);
  const double root = std::sqrt(se.value);
  const double open_slope = std::pow(1 - t, m - 1) * t / se.value;
  return {root * open * open, (0.5 / root * open * open + 2 * root * open * open_slope) * se.slope};
}

}  // namespace

Retention::Permeability Retention::permeability(double psi) const {
  if (psi >= 0) return {1, 0};
  Permeability p{1, 0};
  switch (soil_.model) {
    case RetentionModel::saturated:
      p = {1 + psi / height_ * (1 - dry), (1 - dry) / height_};
      return p.kr > dry ? p : Permeability{dry, 0};
    case RetentionModel::gardner:
      p.kr = std::exp(soil_.alpha * psi);
      p.slope = soil_.alpha * p.kr;
      break;
    case RetentionModel::van_genuchten:
      p = mualem(soil_, psi);
      break;
  }
  return p.kr > least ? p : Permeability{least, 0};
}

double Retention::saturation(double psi) const {
  if (psi >= 0) return 1;
  switch (soil_.model) {
    case RetentionModel::saturated:
      return 0;
    case RetentionModel::gardner:
      return std::exp(soil_.alpha * psi);
    case RetentionModel::van_genuchten:
      return van_genuchten(soil_, psi).value;
  }
  return 1;
}

}  // namespace porosph
