// The lowest vibration of an elastic plate clamped at one end.
#pragma once

namespace porosph {

/// A plate of unit width in plane strain, clamped at x = 0, free at x = L.
struct Cantilever {
  double length = 0;          ///< L [m]
  double thickness = 0;       ///< d [m]
  double youngs_modulus = 0;  ///< E [Pa]
  double poissons_ratio = 0;  ///< nu [-]
  double density = 0;         ///< rho [kg/m3]
};

/// Deflection w across the plate and rotation psi of its sections, scaled to w(L) = 1. A section at x moves
/// with velocity (-psi(x) (y - y_middle), w(x)) times a tip velocity.
struct BendingShape {
  double deflection = 0;  ///< w [-]
  double rotation = 0;    ///< psi [1/m]
};

/// Thin plate (Euler-Bernoulli), angular frequency [rad/s]:
///     omega^2 = E d^2 (kL)^4 / (12 rho (1 - nu^2) L^4),  cos(kL) cosh(kL) = -1,  kL = 1.8751.
/// Landau and Lifshitz, Theory of Elasticity, section 25; the benchmark of Gray, Monaghan and Swift (2001),
/// Comput. Methods Appl. Mech. Engrg. 190, 6641-6662.
double thin_plate_frequency(const Cantilever& plate);

/// Shape of that mode, the initial velocity of Gray, Monaghan and Swift. x from 0 to L [m].
BendingShape thin_plate_shape(const Cantilever& plate, double x);

/// With shear deformation and rotary inertia (Timoshenko), angular frequency [rad/s]; accurate for thicker
/// plates. The lowest root of
///     2P + (p P^2 / (q Q) + q Q / p) cosh(pL) cos(qL) + P (p/q - q/p) sinh(pL) sin(qL) = 0,
///     P = p + alpha/p,  Q = q - alpha/q,  alpha = rho omega^2 / (kappa G),  beta = rho omega^2 (1 - nu^2) /
///     E,
/// where p^2 and -q^2 are the roots l of l^2 + (alpha + beta) l + alpha beta - 12 beta / d^2 = 0.
/// Shear coefficient kappa = 5 / (6 - nu): that of a narrow rectangle, 5 (1 + nu) / (6 + 5 nu), with plane
/// strain's nu / (1 - nu) for nu (Hutchinson 1984, J. Appl. Mech. 51, 279). Throws std::invalid_argument
/// unless 0 < thickness <= length, E, rho > 0 and -1 < nu <= 0.5.
double thick_plate_frequency(const Cantilever& plate);

/// Shape of that mode. x from 0 to L [m].
BendingShape thick_plate_shape(const Cantilever& plate, double x);

}  // namespace porosph
