#include "solver/sph/consistent/closed_gradients.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "solver/space/parallel.hpp"

namespace porosph {
namespace {

constexpr double closed_enough = 1e-3;  ///< RMS of n_a times the spacing
constexpr double regularisation = 1e-3;
constexpr double few = 0.01;  ///< of those that are held
constexpr int most_iterations = 100;

using Vectors = std::vector<Vec2>;
using Matrices = std::vector<Mat2>;

double dot(const Vectors& x, const Vectors& y) {
  return deterministic_sum(x.size(), [&](std::size_t a) { return x[a].dot(y[a]); });
}

/// x = x * factor + y * by.
void combine(Vectors& x, double factor, const Vectors& y, double by) {
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < x.size(); ++a) x[a] = factor * x[a] + by * y[a];
}

class Closing {
 public:
  explicit Closing(const CorrectedGradients& g)
      : g_(g), particles_(g.correction.size()), points_(particles_ + g.ghosts.size()) {
    hold_the_inside();
    held_count_ = std::count(held_.begin(), held_.end(), 1);
  }

  Closure close() {
    if (held_count_ == 0 || is_lattice()) return {};
    Vectors kappa(particles_, Vec2::Zero());
    Vectors residual = imbalance(mirrored({g_.correction.begin(), g_.correction.end()}), spread(kappa));
    if (rms(residual) <= closed_enough) return {};
    solve(kappa, residual);
    Closure closure{.kappa = spread(kappa), .correction = changes(spread(kappa))};
    for (std::size_t a = 0; a < particles_; ++a) closure.correction[a] += g_.correction[a];
    return closure;
  }

 private:
  /// Neighbours leave a sector of more than a right angle open.
  bool at_surface(std::int32_t a) const {
    unsigned octants = 0;
    g_.stencils.for_neighbours(a, [&](std::int32_t, const PairGeometry& g) {
      octants |= 1u << ((g.x > 0) + 2 * (g.y > 0) + 4 * (std::abs(g.x) > std::abs(g.y)));
    });
    if (octants == 0xff) return false;  // two directions in octants side by side are less than that apart
    std::vector<double> angles;
    g_.stencils.for_neighbours(
        a, [&](std::int32_t, const PairGeometry& g) { angles.push_back(std::atan2(g.y, g.x)); });
    if (angles.empty()) return true;
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 2 * std::numbers::pi - angles.back();
    for (std::size_t k = 1; k < angles.size(); ++k) widest = std::max(widest, angles[k] - angles[k - 1]);
    return widest > 0.5 * std::numbers::pi + 1e-6;
  }

  /// n_a is to vanish where no neighbour is at a surface.
  void hold_the_inside() {
    std::vector<std::uint8_t> surface(points_);
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < particles_; ++a)
      surface[a] = g_.fill[a] < 1 || at_surface(static_cast<std::int32_t>(a));
    g_.ghosts.fill<Mirrors::scalar>(surface);
    held_.resize(particles_);
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < particles_; ++a) {
      bool near = surface[a];
      g_.stencils.for_neighbours(static_cast<std::int32_t>(a),
                                 [&](std::int32_t b, const PairGeometry&) { near = near || surface[b]; });
      held_[a] = !near;
    }
  }

  /// But for a few places, which are not worth the work. One row along a wall that the lattice does not fit
  /// is more than that: left as it is, it makes the stress of a box 4 to 50 % wrong.
  bool is_lattice() const {
    const Vectors n = lopsidedness();
    const double irregular = deterministic_sum(particles_, [&](std::size_t a) {
      return n[a].norm() * g_.spacing > closed_enough * g_.volumes[a] ? 1.0 : 0.0;
    });
    return irregular <= few * static_cast<double>(held_count_);
  }

  /// V_a 2 sum_b V_b F_ab x_ab: in a lattice, strained or not, neighbours face each other and it vanishes,
  /// also where n_a does not because neighbours see a surface. Nothing is to be closed there.
  Vectors lopsidedness() const {
    Vectors out(particles_, Vec2::Zero());
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < particles_; ++a) {
      if (!held_[a]) continue;
      g_.stencils.for_neighbours(static_cast<std::int32_t>(a), [&](std::int32_t, const PairGeometry& g) {
        out[a] += 2 * g_.volumes[a] * Vec2(g.x, g.y);
      });
    }
    return out;
  }

  /// Of the particles, and of the ghosts after them.
  Vectors spread(Vectors v) const {
    g_.ghosts.fill<Mirrors::direction>(v);
    return v;
  }
  Matrices mirrored(Matrices m) const {
    g_.ghosts.fill<Mirrors::tensor>(m);
    return m;
  }

  /// By how much kappa changes L where linear fields are to keep their gradients.
  Matrices changes(const Vectors& kappa) const {
    Matrices change(particles_);
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < particles_; ++a) {
      Mat2 of_positions = Mat2::Zero();
      g_.stencils.for_neighbours(static_cast<std::int32_t>(a), [&](std::int32_t b, const PairGeometry& g) {
        of_positions += (kappa[b] - kappa[a]) * Vec2(g.x, g.y).transpose();
      });
      change[a] = -of_positions * g_.correction[a];
    }
    return change;
  }

  /// V_a n_a where it is to vanish, elsewhere 0. `correction` and `kappa` of all points.
  Vectors imbalance(const Matrices& correction, const Vectors& kappa) const {
    Vectors out(particles_, Vec2::Zero());
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < particles_; ++a) {
      if (!held_[a]) continue;
      Vec2 n = Vec2::Zero();
      g_.stencils.for_neighbours(static_cast<std::int32_t>(a), [&](std::int32_t b, const PairGeometry& g) {
        n += (correction[a] + correction[b]) * Vec2(g.x, g.y) + 2 * g.w * (kappa[b] - kappa[a]);
      });
      out[a] = g_.volumes[a] * n;
    }
    return out;
  }

  double rms(const Vectors& residual) const {
    const double squares = deterministic_sum(
        particles_, [&](std::size_t a) { return (residual[a] / g_.volumes[a]).squaredNorm(); });
    return g_.spacing * std::sqrt(squares / static_cast<double>(held_count_));
  }

  /// Diagonal of the equations without their coupling through L.
  std::vector<double> diagonal() const {
    std::vector<double> d(particles_);
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < particles_; ++a) {
      g_.stencils.for_neighbours(static_cast<std::int32_t>(a),
                                 [&](std::int32_t, const PairGeometry& g) { d[a] += g.w; });
      d[a] *= 2 * g_.volumes[a];
    }
    return d;
  }

  /// Conjugate gradients. The equations are symmetric, and nearly singular for kappa that varies slowly,
  /// which changes little and is left out by the regularisation.
  void solve(Vectors& kappa, Vectors& residual) const {
    const std::vector<double> d = diagonal();
    const auto preconditioned = [&](const Vectors& r) {
      Vectors z(particles_);
      for (std::size_t a = 0; a < particles_; ++a) z[a] = held_[a] ? Vec2(r[a] / d[a]) : Vec2(Vec2::Zero());
      return z;
    };
    Vectors z = preconditioned(residual), direction = z;
    double slope = dot(residual, z);
    for (int k = 0; k < most_iterations && rms(residual) > closed_enough; ++k) {
      const Vectors along = spread(direction);
      Vectors image = imbalance(mirrored(changes(along)), along);
      for (std::size_t a = 0; a < particles_; ++a)
        if (held_[a]) image[a] -= regularisation * d[a] * direction[a];
      const double step = -slope / dot(direction, image);
      combine(kappa, 1, direction, step);
      combine(residual, 1, image, step);
      z = preconditioned(residual);
      const double next = dot(residual, z);
      combine(direction, next / slope, z, 1);
      slope = next;
    }
  }

  const CorrectedGradients& g_;
  std::size_t particles_, points_;
  std::vector<std::uint8_t> held_;
  std::int64_t held_count_ = 0;
};

}  // namespace

Closure close_gradients(const CorrectedGradients& gradients) { return Closing(gradients).close(); }

}  // namespace porosph
