#include "solver/water/flow/retention.hpp"

#include <algorithm>
#include <cmath>

#include "solver/space/tensor.hpp"

namespace porosph {
namespace {

constexpr double nearly_full = 1e-3;  // of alpha |psi|
constexpr double dry = 1e-3;          // kr of the saturated model above the water table

struct Curve {
  double value, slope;
};

/// Linear in psi between points of (suction, value), constant beyond the last.
Curve in_table(const std::vector<Vec2>& points, double psi) {
  const double suction = -psi;
  const auto next = std::ranges::find_if(points, [&](const Vec2& p) { return p.x() > suction; });
  if (next == points.end()) return {points.back().y(), 0};
  if (next == points.begin()) return {next->y(), 0};
  const Vec2 &low = *(next - 1), &high = *next;
  const double slope = (high.y() - low.y()) / (high.x() - low.x());
  return {low.y() + slope * (suction - low.x()), -slope};
}

/// As its logarithm.
Retention::Permeability permeability_in_table(const std::vector<Vec2>& points, double psi) {
  std::vector<Vec2> logarithms = points;
  for (Vec2& p : logarithms) p.y() = std::log(p.y());
  const Curve c = in_table(logarithms, psi);
  return {std::exp(c.value), std::exp(c.value) * c.slope};
}

/// Se and dSe/dpsi of van Genuchten, psi < 0.
Curve van_genuchten(const RetentionCase& soil, double psi) {
  const double m = 1 - 1 / soil.n, suction = -soil.alpha * psi, power = std::pow(suction, soil.n);
  const double se = std::pow(1 + power, -m);
  return {se, m * soil.n * soil.alpha * power / suction * se / (1 + power)};
}

/// Mualem 1976 in the closed form of van Genuchten, eq. (8), with 1 - Se^(1/m) = (alpha |psi|)^n Se^(1/m),
/// which keeps its digits near saturation.
Retention::Permeability mualem(const RetentionCase& soil, double psi) {
  const double m = 1 - 1 / soil.n, power = std::pow(-soil.alpha * psi, soil.n);
  const Curve se = van_genuchten(soil, psi);
  const double t = 1 / (1 + power), shut = std::pow(power * t, m), open = 1 - shut;
  const double root = std::sqrt(se.value);
  const double open_slope = shut / (power * se.value);
  return {root * open * open, (0.5 / root * open * open + 2 * root * open * open_slope) * se.slope};
}

/// Linear up to saturation from alpha |psi| = nearly_full on: with n < 2 the slope of Mualem's curve has no
/// bound there.
Retention::Permeability mualem_up_to_full(const RetentionCase& soil, double psi) {
  const double edge = -nearly_full / soil.alpha;
  if (psi < edge) return mualem(soil, psi);
  const double slope = (mualem(soil, edge).kr - 1) / edge;
  return {1 + slope * psi, slope};
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
      p = mualem_up_to_full(soil_, psi);
      break;
    case RetentionModel::table:
      p = permeability_in_table(soil_.permeability, psi);
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
    case RetentionModel::table:
      return in_table(soil_.saturation, psi).value;
  }
  return 1;
}

double Retention::pressure_head(double saturation) const {
  switch (soil_.model) {
    case RetentionModel::saturated:
      return height_ * (saturation - 1);
    case RetentionModel::gardner:
      return std::log(saturation) / soil_.alpha;
    case RetentionModel::van_genuchten: {
      const double m = 1 - 1 / soil_.n;
      return -std::pow(std::pow(saturation, -1 / m) - 1, 1 / soil_.n) / soil_.alpha;
    }
    case RetentionModel::table: {
      const std::vector<Vec2>& points = soil_.saturation;
      const auto below = std::ranges::find_if(points, [&](const Vec2& p) { return p.y() < saturation; });
      if (below == points.end()) return -points.back().x();
      const Vec2 &low = *below, &high = *(below - 1);
      return -std::lerp(high.x(), low.x(), (high.y() - saturation) / (high.y() - low.y()));
    }
  }
  return 0;
}

Retention::Stored Retention::stored(double psi) const {
  if (psi >= 0) return {1, 0};
  switch (soil_.model) {
    case RetentionModel::saturated:
      return psi > -height_ ? Stored{1 + psi / height_, 1 / height_} : Stored{0, 0};
    case RetentionModel::gardner:
      return {std::exp(soil_.alpha * psi), soil_.alpha * std::exp(soil_.alpha * psi)};
    case RetentionModel::van_genuchten: {
      const Curve c = van_genuchten(soil_, psi);
      return {c.value, c.slope};
    }
    case RetentionModel::table: {
      const Curve c = in_table(soil_.saturation, psi);
      return {c.value, c.slope};
    }
  }
  return {1, 0};
}

}  // namespace porosph
