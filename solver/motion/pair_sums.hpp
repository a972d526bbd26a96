// The sums over neighbours that all motion equations are made of, as vector code.
#pragma once

#include <cstdint>

#include "solver/motion/kernels/record.hpp"
#include "solver/neighbours/neighbour_list.hpp"
#include "solver/tensor.hpp"

namespace porosph {

inline Pair load_pair(const double* p) { return Pair{p[0], p[1]}; }

/// A pair's stored kernel gradient, V_b grad_a W_ab (corrected or not, as the motion equation needs it)
/// [1/m].
struct PairGradient {
  double x, y;
};

/// sum_b q_b G_ab: the sums that all forms of the motion equation are made of.
struct PairSums {
  Lanes x{}, y{};
};

/// sum_b (v_b - v_a) (x) G_ab of particle a, where `gradient_sum` = sum_b G_ab [1/s]. Two partial sums of
/// each: an addition need not wait for the one before.
inline Mat2 velocity_sum(const NeighbourList& neighbours, const PairGradient* gradient,
                         const Vec2* velocities, const Vec2& gradient_sum, std::size_t a) {
  const std::int32_t* index = neighbours.index.data();
  const auto velocity = [&](std::int64_t k) { return load_pair(velocities[index[k]].data()); };
  Pair x{}, y{}, x2{}, y2{};  // of v G_x and of v G_y
  const std::int64_t last = neighbours.begin[a + 1];
  std::int64_t k = neighbours.begin[a];
  for (; k + 1 < last; k += 2) {
    const Pair v = velocity(k), v2 = velocity(k + 1);
    x += v * gradient[k].x, x2 += v2 * gradient[k + 1].x;
    y += v * gradient[k].y, y2 += v2 * gradient[k + 1].y;
  }
  if (k < last) x += velocity(k) * gradient[k].x, y += velocity(k) * gradient[k].y;
  x += x2, y += y2;
  return (Mat2() << x[0], y[0], x[1], y[1]).finished() - velocities[a] * gradient_sum.transpose();
}

}  // namespace porosph
