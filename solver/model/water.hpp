// Still water and the pore pressure it makes.
#pragma once

#include <algorithm>

#include "solver/case/case.hpp"
#include "solver/model/particles.hpp"

namespace porosph {

/// Hydrostatic water, level per stretch of x.
class Water {
 public:
  Water() = default;
  explicit Water(const WaterCase& water) : unit_weight_(water.unit_weight), stretches_(water.stretches) {}

  bool present() const { return !stretches_.empty(); }
  double unit_weight() const { return unit_weight_; }  ///< gamma_w [N/m3]

  /// Height of the water level at x above y; negative or -never where the point is dry [m].
  double depth(double x, double y) const {
    for (const WaterStretch& s : stretches_)
      if (x >= s.x_from && x <= s.x_to) return s.level - y;
    return -never;
  }

  /// p_w, negative in compression, zero above the level (eq. 12) [Pa].
  double pore_pressure(double x, double y) const { return -unit_weight_ * std::max(0.0, depth(x, y)); }

  /// p_w of particles first to last - 1, where they are now.
  void pore_pressures(Particles& p, std::size_t first, std::size_t last) const {
    const bool everywhere =
        stretches_.size() == 1 && stretches_[0].x_from == -never && stretches_[0].x_to == never;
    if (everywhere) {
      const double level = stretches_[0].level, gamma = unit_weight_;
      const double* x = p.position.data()->data();
      double* pressure = p.pore_pressure.data();
#pragma omp simd
      for (std::size_t i = first; i < last; ++i) {
        const double depth = level - x[2 * i + 1];
        pressure[i] = depth > 0 ? -gamma * depth : -0.0;
      }
    } else {
      for (std::size_t i = first; i < last; ++i)
        p.pore_pressure[i] = pore_pressure(p.position[i].x(), p.position[i].y());
    }
  }

  /// p_w behind a wall: at the image's height, below the level in front of the wall (a stretch may end there)
  /// [Pa].
  double pore_pressure_behind_wall(const Point& particle, const Point& image) const {
    return pore_pressure(particle.x(), image.y());
  }

 private:
  double unit_weight_ = 0;
  std::vector<WaterStretch> stretches_;
};

}  // namespace porosph
