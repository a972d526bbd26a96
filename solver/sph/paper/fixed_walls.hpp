// Fixed walls in the paper's forms: rows of virtual particles behind them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {

/// Virtual particles stay where they are: mirror images of the soil as it lies at first, in the fixed walls
/// and from there in the rollers (corners). Where soil yields, rows of them lie along the rest of each wall
/// as well, where soil may flow to. They take the stress of the particle that looks at them, and the velocity
/// -min(d_b / d_a, 1/2) v_a that makes it stick to the wall (Morris et al. 1997; Bui et al. 2008).
class FixedWalls {
 public:
  /// `reach`: how far from a wall particles may lie that see virtual ones [m].
  FixedWalls(const Model& model, double reach);

  /// The model's first walls are the fixed ones: so many.
  std::size_t count() const { return count_; }

  /// Finds the virtual neighbours of particles within `reach` [m].
  void search(std::span<const Vec2> positions, double reach);
  bool near(std::size_t a) const { return neighbours_.begin[a] < neighbours_.begin[a + 1]; }

  /// Makes the uncorrected gradients g of a particle's pairs; returns sum g (x) (x_b - x_a).
  Mat2 make_gradients(std::size_t a, const Vec2& place);
  /// Corrects them to G = L g, and sums.
  void correct(std::size_t a, const Vec2& place, const Mat2& correction);

  /// Over a particle's virtual neighbours.
  struct Sums {
    Vec2 gradient = Vec2::Zero();  ///< of G [1/m]
    Vec2 pressure = Vec2::Zero();  ///< of p_b G [Pa/m]
  };
  const Sums& sums(std::size_t a) const { return sums_[a]; }
  /// Of stickiness G, x or y [1/m].
  const double* velocity(int component) const { return velocity_[component].data(); }

  /// Calls use(place of b, G, stickiness) for each virtual neighbour b of particle a.
  template <class Use>
  void for_neighbours(std::size_t a, Use&& use) const {
    for (std::int64_t k = neighbours_.begin[a]; k < neighbours_.begin[a + 1]; ++k)
      use(points_[neighbours_.index[k]], gradient_[k], stickiness_[k]);
  }

 private:
  void continue_along_walls(double reach);
  const Model& model_;
  CubicSpline<2> kernel_;
  std::size_t count_ = 0;
  std::vector<Vec2> points_;
  std::vector<double> volume_;
  std::vector<std::int32_t> wall_;
  std::vector<double> pressure_;

  NeighbourList neighbours_;
  std::vector<Vec2> gradient_;      ///< G of each pair
  std::vector<double> stickiness_;  ///< of each pair: 1 + min(d_b / d_a, 1/2)
  std::vector<Sums> sums_;
  std::array<std::vector<double>, 2> velocity_;
};

}  // namespace porosph
