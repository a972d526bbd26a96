// Displacements that alternate from particle to particle: what neither strain nor unbalanced forces show.
#pragma once

#include "solver/model/model.hpp"

namespace porosph {

/// A particle's zigzag is its displacement less the mean of what its neighbours of the same soil foretell,
/// u_b - (G_a + G_b) (x_b - x_a) / 2, with G the gradient of the displacement fitted to their neighbours. It
/// is zero for displacements that are linear or quadratic. Amplitudes are those of rows that move up and down
/// in turn.
struct Zigzag {
  /// Over the RMS difference of the displacements of neighbours [-]. Where stiff soil hardly deforms, and
  /// soft soil has no particles that count, at least the difference counts that spreads the largest
  /// displacement evenly over the body's length.
  double rms = 0;
  double quantile = 0;  ///< 99 % of the particles have less, over the same [-]
  double largest = 0;   ///< amplitude [m]
  Vec2 where{0, 0};     ///< of the particle with the largest, at t = 0, in the case's coordinates [m]
};

/// Over particles whose neighbours have neighbours on all sides, as they have, and where soil has not flowed
/// (|G| < 0.5); all zero where there are none, or nothing has moved.
Zigzag measure_zigzag(const Model& model);

}  // namespace porosph
