// How far a run at rest is from finite elements.
#pragma once

#include "solver/sweep/judge.hpp"

namespace porosph {

/// Solves the case with finite elements (kept, for other runs of the same soil). Particles within two and a
/// half spacings of a corner of an outline do not count: stress may be singular there. May be called from
/// any thread. Throws std::runtime_error where the case has no such reference.
ErrorMeasure fem_measure(const Case& scene);

}  // namespace porosph
