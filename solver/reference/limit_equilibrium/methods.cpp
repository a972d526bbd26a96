#include "solver/reference/limit_equilibrium/methods.hpp"

#include <algorithm>
#include <cmath>

namespace porosph::limit_equilibrium {
namespace {

constexpr double least_share = 0.2;  // of m_alpha = cos + sin tan(phi) / F: less makes forces without bounds
constexpr double smallest_factor = 0.01, largest_factor = 100;

/// c l - u l tan(phi): strength along the base without the normal force.
double bare_strength(const Slice& s) {
  return s.length * (s.strength.cohesion - s.pore_pressure * s.strength.tan_friction);
}

/// E_left - E_right of a slice with thrusts E on its sides, shear lambda E, vertical load P and push H to the
/// right. With N eliminated,
///   (E_left - E_right) [F cos + t sin + lambda (F sin - t cos)] = F (P sin - H cos) - [c l - u l t + t (P
///   cos
///   + H sin)],    t = tan(phi).
struct Balance {
  double difference, slope, share, drive;

  Balance(const Slice& s, double factor, double lambda)
      : slope(s.cosine + lambda * s.sine), drive((s.weight + s.press) * s.sine - s.push * s.cosine) {
    const double t = s.strength.tan_friction;
    share = factor * slope + t * (s.sine - lambda * s.cosine);
    const double resist = bare_strength(s) + t * ((s.weight + s.press) * s.cosine + s.push * s.sine);
    difference = (factor * drive - resist) / share;
  }
};

}  // namespace

std::optional<double> bishop(std::span<const Slice> slices, const Point& centre, double radius) {
  double driving = 0;  // clockwise moment over the radius
  for (const Slice& s : slices)
    driving += s.weight * (s.base.x() - centre.x()) - (s.torque + centre.x() * s.press + centre.y() * s.push);
  driving /= radius;
  if (driving <= 0) return std::nullopt;
  double factor = 1;
  for (int i = 0; i < 100; ++i) {
    double resisting = 0;
    for (const Slice& s : slices) {
      const double t = s.strength.tan_friction, share = s.cosine + s.sine * t / factor;
      if (share < least_share) return std::nullopt;
      resisting += ((s.strength.cohesion - s.pore_pressure * t) * s.width + (s.weight + s.press) * t) / share;
    }
    const double next = resisting / driving;
    if (!(next > smallest_factor && next < largest_factor)) return std::nullopt;
    const bool same = std::abs(next - factor) < 1e-9 * factor;
    factor = next;
    if (same) return factor;
  }
  return std::nullopt;
}

std::optional<SpencerResult> spencer(std::span<const Slice> slices, const SpencerResult& guess) {
  if (slices.empty()) return std::nullopt;
  const Point origin = slices[slices.size() / 2].base;
  double factor = guess.factor, lambda = guess.inclination;
  for (int i = 0; i < 60; ++i) {
    double force = 0, force_by_f = 0, force_by_l = 0, moment = 0, moment_by_f = 0, moment_by_l = 0, size = 0;
    for (const Slice& s : slices) {
      const Balance b(s, factor, lambda);
      if (b.share < least_share * factor) return std::nullopt;
      const double by_f = (b.drive - b.difference * b.slope) / b.share;
      const double by_l = -b.difference * (factor * s.sine - s.strength.tan_friction * s.cosine) / b.share;
      const double x = s.base.x() - origin.x(), y = s.base.y() - origin.y(), arm = y - lambda * x;
      force += b.difference, force_by_f += by_f, force_by_l += by_l;
      moment += b.difference * arm + s.push * y + s.press * x + s.torque + origin.x() * s.press +
                origin.y() * s.push;
      moment_by_f += by_f * arm, moment_by_l += by_l * arm - b.difference * x;
      size += std::abs(b.difference);
    }
    const double determinant = force_by_f * moment_by_l - force_by_l * moment_by_f;
    double change = -(force * moment_by_l - force_by_l * moment) / determinant;
    double turn = -(force_by_f * moment - force * moment_by_f) / determinant;
    if (!std::isfinite(change) || !std::isfinite(turn)) return std::nullopt;
    const double much = std::max(std::abs(change) / (0.3 * factor), std::abs(turn) / 0.3);
    if (much > 1) change /= much, turn /= much;
    factor += change, lambda += turn;
    if (factor < smallest_factor || factor > largest_factor || std::abs(lambda) > 3) return std::nullopt;
    if (std::abs(change) < 1e-9 * factor && std::abs(turn) < 1e-9 && std::abs(force) <= 1e-6 * size)
      return SpencerResult{factor, lambda};
  }
  return std::nullopt;
}

}  // namespace porosph::limit_equilibrium
