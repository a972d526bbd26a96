// What particles near another soil know of their own side of the interface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/sph/kernels/consistent_kernels.hpp"

namespace porosph {

/// A displacement that is continuous and linear in each soil bends where they meet, by c (x) n, such that the
/// traction continues: (C' : (G + c (x) n)) n = (C : G) n. A sum over both sides gives T : G in place of the
/// own side's gradient G, with T = I + sum_b phi_b (n . L grad W_ab V_b) B (x) n, B : G = c, and phi_b the
/// distance of b beyond the interface. Stress and zero-energy control use A = T^-1 times the summed gradient;
/// F and the rotation stay those of the sum.
///
/// C A need not be symmetric where Poisson's ratios differ, and the forces would do work that the strain does
/// not. A stress tau t (x) t along the interface, whose rate is `tie` : G, makes it so.
struct OwnSides {
  std::vector<std::int32_t> particle;            ///< those whose kernel reaches into another soil, in order
  std::array<std::vector<double>, 16> gradient;  ///< A, row by row over xx, xy, yx, yy
  std::array<std::vector<double>, 4> tie;        ///< [Pa]
  std::array<std::vector<double>, 2> along;      ///< t, the unit vector along the interface
  std::vector<std::int32_t> place;               ///< of each particle of the model, or -1; empty in one soil
  std::vector<std::int32_t> kind;                ///< of each soil: the first of the same stiffness

  bool empty() const { return particle.empty(); }
  Vec2 tangent(std::size_t k) const { return {along[0][k], along[1][k]}; }  ///< of the particle at this place
  /// A : m of the particle at this place.
  Mat2 of(std::size_t place, const Mat2& m) const;
  /// The same of a velocity gradient, whose rotation stays that of the sum.
  Mat2 rate_of(std::size_t place, const Mat2& m) const;
  void connect(OwnSideView& view) const;
};

}  // namespace porosph
