// Bearing capacity of a strip footing on heavy frictional soil, by the method of characteristics (Sokolovskii
// 1965; Martin 2005).
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace porosph::verification {

/// Soil of unit weight 1 without cohesion that yields everywhere around the edge of a footing, which is the
/// origin: the footing lies at x < 0, a surcharge so small that it is without effect at x > 0; z is down. The
/// largest principal stress has the angle theta with x, and sigma is the middle of Mohr's circle. Along two
/// families of slip lines, with mu = pi/4 - phi/2,
///
///   dz/dx = tan(theta + mu):  d sigma + 2 sigma tan(phi) d theta = dz + tan(phi) dx
///   dz/dx = tan(theta - mu):  d sigma - 2 sigma tan(phi) d theta = dz - tan(phi) dx.
///
/// Lines of the second family come from the surface through Rankine's passive zone and a fan of lines of the
/// first family around the edge. They end on the footing, where a new line of the first family begins: theta
/// is pi/2 under a smooth footing, pi - mu where the soil slides along a rough one.
class SlipLines {
 public:
  SlipLines(double friction_degrees, bool rough)
      : phi_(friction_degrees * pi / 180), tan_(std::tan(phi_)), mu_(pi / 4 - phi_ / 2), rough_(rough) {
    trace();
  }

  /// Mean pressure on the footing over its half width.
  double n_gamma() const {
    if (!rough_) return pressing_down_to(lines_.size() - 1) / square(lines_.back().back().x);
    // The widest footing whose last line has been followed to the axis.
    for (std::size_t k = lines_.size() - 1; k > 0; --k)
      if (const auto found = with_wedge(k)) return *found;
    return 0;
  }

 private:
  static constexpr double pi = std::numbers::pi, surcharge = 1e-6, growth = 1.04;
  static constexpr int lines_in_fan = 60, lines_from_surface = 400;

  struct Point {
    double x, z, sigma, theta;
  };
  using Line = std::vector<Point>;

  static double square(double x) { return x * x; }
  double at_footing() const { return rough_ ? pi - mu_ : pi / 2; }
  double passive(double z) const { return (z + surcharge) / (1 - std::sin(phi_)); }
  double vertical(const Point& p) const { return p.sigma * (1 - std::sin(phi_) * std::cos(2 * p.theta)); }
  double shear(const Point& p) const { return p.sigma * std::sin(phi_) * std::sin(2 * p.theta); }

  /// Where a line of the first family from `a` meets one of the second from `b`.
  Point meet(const Point& a, const Point& b) const {
    Point p = b;
    for (int k = 0; k < 10; ++k) {
      const double first = (a.theta + p.theta) / 2 + mu_, second = (b.theta + p.theta) / 2 - mu_;
      // sin(t) x - cos(t) z = constant, which upright lines have too.
      const double s1 = std::sin(first), c1 = std::cos(first), s2 = std::sin(second), c2 = std::cos(second);
      const double r1 = s1 * a.x - c1 * a.z, r2 = s2 * b.x - c2 * b.z, det = c1 * s2 - s1 * c2;
      p.x = (c1 * r2 - c2 * r1) / det, p.z = (s1 * r2 - s2 * r1) / det;
      const double ka = (a.sigma + p.sigma) * tan_, kb = (b.sigma + p.sigma) * tan_;
      const double fa = a.sigma + ka * a.theta + (p.z - a.z) + tan_ * (p.x - a.x);
      const double fb = b.sigma - kb * b.theta + (p.z - b.z) - tan_ * (p.x - b.x);
      p.theta = (fa - fb) / (ka + kb), p.sigma = (kb * fa + ka * fb) / (ka + kb);
    }
    return p;
  }

  /// Where a line of the second family from `b` meets the footing.
  Point meet_footing(const Point& b) const {
    const double slope = (b.theta + at_footing()) / 2 - mu_, turn = tan_ * (at_footing() - b.theta);
    const double x = b.x - b.z / std::tan(slope);
    return {x, 0, (b.sigma * (1 + turn) - b.z - tan_ * (x - b.x)) / (1 - turn), at_footing()};
  }

  /// The next line of the second family: from the surface at x, which the border of the passive zone meets at
  /// half of that.
  Line next(const Line& inside, double x) const {
    const double z = x / 2 * std::tan(mu_);
    Line line{{x / 2, z, passive(z), 0}};
    for (std::size_t k = 1; k < inside.size(); ++k) line.push_back(meet(inside[k], line.back()));
    line.push_back(meet_footing(line.back()));
    return line;
  }

  void trace() {
    Line edge;  // which all lines of the fan leave
    for (int k = 0; k <= lines_in_fan; ++k) {
      const double theta = at_footing() * k / lines_in_fan;
      edge.push_back({0, 0, passive(0) * std::exp(2 * tan_ * theta), theta});
    }
    lines_.push_back(edge);
    double x = surcharge;
    for (int k = 0; k < lines_from_surface; ++k, x *= growth) lines_.push_back(next(lines_.back(), x));
  }

  /// Force on the footing from its edge to where line k ends on it.
  double pressing_down_to(std::size_t k) const {
    double force = 0;
    for (std::size_t j = 1; j <= k; ++j) {
      const Point &a = lines_[j - 1].back(), &b = lines_[j].back();
      force += (vertical(a) + vertical(b)) / 2 * (a.x - b.x);
    }
    return force;
  }

  /// N_gamma of the footing under which the line of the first family that begins where line k ends on it goes
  /// down to the axis. The soil above that line moves with the footing.
  std::optional<double> with_wedge(std::size_t k) const {
    const std::size_t number = lines_[k].size() - 1;
    double force = pressing_down_to(k);
    for (std::size_t j = k + 1; j < lines_.size(); ++j) {
      const Point& a = lines_[j - 1][number];
      Point b = lines_[j][number];
      const bool at_axis = b.theta < pi / 2;
      if (at_axis) {
        const double part = (a.theta - pi / 2) / (a.theta - b.theta);
        b = {a.x + part * (b.x - a.x), a.z + part * (b.z - a.z), a.sigma + part * (b.sigma - a.sigma),
             pi / 2};
      }
      const double dx = a.x - b.x, dz = b.z - a.z, weight = (a.z + b.z) / 2 * dx;
      force += (vertical(a) + vertical(b)) / 2 * dx + (shear(a) + shear(b)) / 2 * dz - weight;
      if (at_axis) return force / square(b.x);
    }
    return std::nullopt;
  }

  double phi_, tan_, mu_;
  bool rough_;
  std::vector<Line> lines_;  ///< of the second family; point k of each lies on line k of the first
};

}  // namespace porosph::verification
