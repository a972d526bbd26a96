#include "solver/reference/exact/cantilever.hpp"

#include <cmath>
#include <stdexcept>

#include "solver/reference/exact/root.hpp"

namespace porosph {
namespace {

/// Wave numbers of Timoshenko's beam at one frequency, see thick_plate_frequency().
struct Waves {
  double p = 0, q = 0;  // [1/m]
  double P = 0, Q = 0;  // rotation per deflection [1/m]
};

void check(const Cantilever& plate) {
  if (!(plate.thickness > 0 && plate.thickness <= plate.length))
    throw std::invalid_argument("cantilever: the thickness must be positive and at most the length");
  if (!(plate.youngs_modulus > 0 && plate.density > 0))
    throw std::invalid_argument("cantilever: Young's modulus and density must be positive");
  if (!(plate.poissons_ratio > -1 && plate.poissons_ratio <= 0.5))
    throw std::invalid_argument("cantilever: Poisson's ratio must be above -1 and at most 0.5");
}

double plate_modulus(const Cantilever& plate) {
  return plate.youngs_modulus / (1 - plate.poissons_ratio * plate.poissons_ratio);
}

Waves waves_at(const Cantilever& plate, double omega) {
  const double shear_modulus = plate.youngs_modulus / (2 * (1 + plate.poissons_ratio));
  const double kappa = 5 / (6 - plate.poissons_ratio);
  const double alpha = plate.density * omega * omega / (kappa * shear_modulus);
  const double beta = plate.density * omega * omega / plate_modulus(plate);
  const double root = std::hypot((alpha - beta) / 2, std::sqrt(12 * beta) / plate.thickness);
  const double p = std::sqrt(root - (alpha + beta) / 2), q = std::sqrt(root + (alpha + beta) / 2);
  return {p, q, p + alpha / p, q - alpha / q};
}

/// cos(kL) cosh(kL) = -1
double first_thin_root() {
  return find_root([](double x) { return std::cos(x) * std::cosh(x) + 1; }, 1, 3);
}

/// Meets w = psi = 0 at x = 0 and vanishing bending moment at x = L, not scaled.
BendingShape shape_at(const Waves& waves, double length, double x) {
  const auto [p, q, P, Q] = waves;
  // w = cosh px - cos qx + B (sinh px - P/Q sin qx); psi'(L) = 0 gives B
  const double b = -(p * P * std::cosh(p * length) + q * Q * std::cos(q * length)) /
                   (P * (p * std::sinh(p * length) + q * std::sin(q * length)));
  return {std::cosh(p * x) - std::cos(q * x) + b * (std::sinh(p * x) - P / Q * std::sin(q * x)),
          P * std::sinh(p * x) + Q * std::sin(q * x) + b * P * (std::cosh(p * x) - std::cos(q * x))};
}

BendingShape scaled_shape(const Waves& waves, double length, double x) {
  const double tip = shape_at(waves, length, length).deflection;
  const BendingShape shape = shape_at(waves, length, x);
  return {shape.deflection / tip, shape.rotation / tip};
}

}  // namespace

double thin_plate_frequency(const Cantilever& plate) {
  check(plate);
  const double k = first_thin_root() / plate.length;
  return k * k * plate.thickness * std::sqrt(plate_modulus(plate) / (12 * plate.density));
}

BendingShape thin_plate_shape(const Cantilever& plate, double x) {
  check(plate);
  const double k = first_thin_root() / plate.length;
  return scaled_shape({k, k, k, k}, plate.length, x);
}

double thick_plate_frequency(const Cantilever& plate) {
  const auto residual = [&](double omega) {
    const auto [p, q, P, Q] = waves_at(plate, omega);
    const double pl = p * plate.length, ql = q * plate.length;
    return 2 + (p * P / (q * Q) + q * Q / (p * P)) * std::cosh(pl) * std::cos(ql) +
           (p / q - q / p) * std::sinh(pl) * std::sin(ql);
  };
  // Shear and rotary inertia only lower the frequency, and by less than to the next mode.
  const double highest = thin_plate_frequency(plate);
  return find_root(residual, highest / 100, highest);
}

BendingShape thick_plate_shape(const Cantilever& plate, double x) {
  return scaled_shape(waves_at(plate, thick_plate_frequency(plate)), plate.length, x);
}

}  // namespace porosph
