#include "solver/reference/exact/dynamic_column.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace porosph {
namespace {

using std::numbers::pi;

/// u_static continued to all y: odd about the bottom, even about the top, so of period 4H.
double continued_displacement(const DynamicColumn& column, double y) {
  const double folded = std::remainder(y, 4 * column.height), z = std::abs(folded);
  return -std::copysign(column.unit_weight / column.modulus * z * (column.height - z / 2), folded);
}

/// M times its derivative: a triangle wave.
double continued_stress(const DynamicColumn& column, double y) {
  return -column.unit_weight * (column.height - std::abs(std::remainder(y, 4 * column.height)));
}

/// Sums term(n, k_n) * (phi_n - exp(-c_d t / 2) cos(omega_n t)), which vanishes without damping.
template <typename Term>
double damped_rest(const DynamicColumn& column, double time, Term term) {
  if (column.damping == 0) return 0;
  // At least up to modes of twice the frequency c_d, where the terms have begun to fall.
  const int modes =
      std::max(1000, static_cast<int>(4 * column.damping * column.height / (pi * column.wave_speed())));
  const double envelope = std::exp(-column.damping * time / 2);
  double sum = 0;
  for (int n = modes; n >= 1; --n) {
    const double omega = column.frequency(n);
    const double rest = DynamicColumn::decay(omega, column.damping, time) - envelope * std::cos(omega * time);
    sum += term(omega / column.wave_speed()) * rest;
  }
  return sum;
}

}  // namespace

double DynamicColumn::wave_speed() const { return std::sqrt(modulus / density); }
double DynamicColumn::period() const { return 4 * height / wave_speed(); }
double DynamicColumn::frequency(int mode) const { return (2 * mode - 1) * pi * wave_speed() / (2 * height); }

double DynamicColumn::decay(double omega, double damping, double time) {
  const double half = damping / 2, discriminant = half * half - omega * omega;
  const double rate = std::sqrt(std::abs(discriminant));
  const double envelope = std::exp(-half * time);
  if (discriminant < 0) return envelope * (std::cos(rate * time) + half / rate * std::sin(rate * time));
  if (rate * time < 1) {  // near critical damping: no difference of large numbers
    const double sinh_over_rate = rate > 0 ? std::sinh(rate * time) / rate : time;
    return envelope * (std::cosh(rate * time) + half * sinh_over_rate);
  }
  const double slow = omega * omega / (half + rate), fast = half + rate;
  return (fast * std::exp(-slow * time) - slow * std::exp(-fast * time)) / (2 * rate);
}

double DynamicColumn::displacement(double y, double time) const {
  const double travelled = wave_speed() * time;
  const double waves =
      (continued_displacement(*this, y + travelled) + continued_displacement(*this, y - travelled)) / 2;
  const double rest = damped_rest(*this, time, [&](double k) {
    return -2 * unit_weight / (modulus * height * k * k * k) * std::sin(k * y);
  });
  return continued_displacement(*this, y) - std::exp(-damping * time / 2) * waves - rest;
}

double DynamicColumn::vertical_stress(double y, double time) const {
  const double travelled = wave_speed() * time;
  const double waves = (continued_stress(*this, y + travelled) + continued_stress(*this, y - travelled)) / 2;
  const double rest = damped_rest(
      *this, time, [&](double k) { return -2 * unit_weight / (height * k * k) * std::cos(k * y); });
  return continued_stress(*this, y) - std::exp(-damping * time / 2) * waves - rest;
}

}  // namespace porosph
