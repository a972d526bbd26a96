// Factors of safety of what lies above one slip surface.
#pragma once

#include <optional>
#include <span>

#include "solver/reference/limit_equilibrium/slices.hpp"

namespace porosph::limit_equilibrium {

/// Bishop's simplified method (1955) on a circle about `centre`: moments about it, and vertical equilibrium
/// of each slice without shear between slices. Nothing where nothing drives the soil down, or where a base is
/// too steep for its friction (Whitman and Bailey 1967).
std::optional<double> bishop(std::span<const Slice> slices, const Point& centre, double radius);

struct SpencerResult {
  double factor = 0;
  double inclination = 0;  ///< shear over thrust between slices, one number for all [-]
};
/// Spencer's method (1967; for any surface 1973): shear between slices is `inclination` times their thrust,
/// and forces and moments of the whole body are in balance. `guess` is where Newton's iteration begins.
/// Nothing where it finds no solution: there is none where steep soil would hang on its crest in tension.
std::optional<SpencerResult> spencer(std::span<const Slice> slices, const SpencerResult& guess);

}  // namespace porosph::limit_equilibrium
