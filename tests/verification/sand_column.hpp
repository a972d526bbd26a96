// A column of Byrne's sand on a base that shakes, by finite differences in one dimension: what the particles
// of a periodic strip are compared with. Nothing of the solver is used but the course of the base.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/run/base_motion.hpp"

namespace porosph::verification {

/// Horizontal displacement at nodes, stress and water in the cells between them. Upright, stress and excess
/// pressure bear the weight at all times; soil changes its volume by the water that flows.
class SandColumn {
 public:
  /// Of a case with one soil on y = 0, `damping` c_d [1/s].
  SandColumn(const Case& scene, int cells, double damping)
      : scene_(scene), soil_(scene.soils[0]), damping_(damping), cells_(cells), v_(cells + 1) {
    double top = 0;
    for (const Point& p : soil_.polygon) top = std::max(top, p.y());
    size_ = top / cells;
    shear_ = soil_.youngs_modulus / (2 * (1 + soil_.poissons_ratio));
    bulk_ = soil_.youngs_modulus / (3 * (1 - 2 * soil_.poissons_ratio));
    for (int i = 0; i < cells; ++i) {
      const double weight =
          (soil_.unit_weight_saturated - scene.water.unit_weight) * (top - (i + 0.5) * size_);
      cells_[i].weight = -weight;
      cells_[i].yy = -weight, cells_[i].xx = cells_[i].zz = -scene.loading.k0 * weight;
    }
    const double wave = std::sqrt(shear_ / density()),
                 flow = 0.2 * size_ * size_ / (conductivity() * modulus());
    dt_ = std::min(0.5 * size_ / wave, flow);
  }

  void run_to(double time) {
    while (time_ < time) step(std::min(dt_, time - time_ + 1e-12));
  }
  /// Excess pressure over the effective stress at the start, at a height [m].
  double ratio(double y) const {
    const double at = std::clamp(y / size_ - 0.5, 0.0, static_cast<double>(cells_.size()) - 1.000001);
    const auto i = static_cast<std::size_t>(at);
    const auto of = [](const Cell& c) { return (c.yy - c.weight) / -c.weight; };
    return of(cells_[i]) + (at - static_cast<double>(i)) * (of(cells_[i + 1]) - of(cells_[i]));
  }
  double settlement() const {
    double sum = 0;
    for (const Cell& c : cells_) sum -= c.strain * size_;
    return sum;
  }

 private:
  struct Cell {
    double weight = 0, xx = 0, yy = 0, zz = 0, xy = 0;  // effective, tension positive [Pa]
    double strain = 0, opening = 0, compaction = 0;     // upright; of volume
    double shear = 0, turned = 0, farthest = 0;         // of gamma
  };
  double density() const { return soil_.unit_weight_saturated / scene_.loading.gravity; }
  double conductivity() const { return soil_.permeability.y() / scene_.water.unit_weight; }
  double modulus() const { return bulk_ + 4 * shear_ / 3; }

  void step(double dt) {
    const std::size_t n = cells_.size();
    const double base = base_acceleration(scene_.shaking, time_), mass = density() * size_;
    for (std::size_t i = 1; i <= n; ++i) {
      const double above = i < n ? cells_[i].xy : 0, force = above - cells_[i - 1].xy;
      v_[i] += dt * (force / (i < n ? mass : mass / 2) - base - damping_ * v_[i]);
    }
    std::vector<double> flow(n + 1, 0);  // upwards through the nodes, out of a surface without excess [m/s]
    const auto excess = [&](std::size_t i) { return cells_[i].yy - cells_[i].weight; };
    for (std::size_t i = 1; i < n; ++i) flow[i] = conductivity() * (excess(i - 1) - excess(i)) / size_;
    flow[n] = conductivity() * excess(n - 1) / (size_ / 2);
    for (std::size_t i = 0; i < n; ++i)
      strain(cells_[i], dt * (v_[i + 1] - v_[i]) / size_, -dt * (flow[i + 1] - flow[i]) / size_);
    time_ += dt;
  }

  /// Sum over half-cycles of Byrne's equation.
  double compact(Cell& c, double gamma) const {
    c.shear += gamma;
    const bool rises = c.farthest >= c.turned;
    if (rises ? c.shear > c.farthest : c.shear < c.farthest) c.farthest = c.shear;
    if (std::abs(c.shear - c.farthest) <= 2 * soil_.compaction.threshold) return 0;
    const double amplitude = std::abs(c.farthest - c.turned) / 2;
    c.turned = c.farthest, c.farthest = c.shear;
    if (amplitude == 0) return 0;
    const double more =
        soil_.compaction.c1 / 2 * amplitude * std::exp(-soil_.compaction.c2 * c.compaction / amplitude);
    c.compaction += more;
    return more;
  }

  /// Plastic flow keeps the volume: stress in the plane returns towards its middle, the one across it into
  /// the range between those two.
  void strain(Cell& c, double gamma, double upright) const {
    const double shut = std::min(c.opening, std::max(0.0, -upright));
    const double all = bulk_ * (compact(c, gamma) + shut), beside = modulus() - 2 * shear_;
    c.strain += upright, c.opening -= shut;
    c.yy += modulus() * upright + all;
    c.xx += beside * upright + all, c.zz += beside * upright + all;
    c.xy += shear_ * gamma;
    const double sine = std::sin(soil_.strength.friction_angle * std::numbers::pi / 180);
    const double middle = (c.xx + c.yy) / 2, half = (c.yy - c.xx) / 2, radius = std::hypot(half, c.xy);
    const double scale = radius > -middle * sine ? std::max(0.0, -middle * sine) / radius : 1;
    const double across =
        std::clamp(c.zz, std::min(0.0, middle * (1 + sine)), std::min(0.0, middle * (1 - sine)));
    const double given = (c.zz - across) / 2;
    c.xx = middle - scale * half + given, c.yy = middle + scale * half + given, c.zz = across, c.xy *= scale;
    const double mean = (c.xx + c.yy + c.zz) / 3;
    if (mean < 0 && c.xx + c.yy < 0) return;
    c.opening += std::max(0.0, mean) / bulk_;
    c.xx = c.yy = c.zz = c.xy = 0;
  }

  Case scene_;
  SoilCase soil_;
  double damping_, size_ = 0, shear_ = 0, bulk_ = 0, dt_ = 0, time_ = 0;
  std::vector<Cell> cells_;
  std::vector<double> v_;
};

}  // namespace porosph::verification
