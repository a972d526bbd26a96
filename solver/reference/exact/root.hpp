// The root of a function between two points.
#pragma once

#include <functional>

namespace porosph {

/// A root of f between low and high, to the last few bits (TOMS 748). Throws std::domain_error if f has the
/// same sign at both.
double find_root(const std::function<double(double)>& f, double low, double high);

}  // namespace porosph
