// What one core of this machine can do at best: read memory, and multiply and add.
#pragma once

#include <cstddef>

namespace porosph::bench {

/// Rate at which `threads` threads together read an array of this size again and again [bytes/s].
double read_rate(std::size_t bytes, int threads, double seconds);

/// Rate of one core's multiply-adds on its widest vector units, two operations each [1/s].
double arithmetic_rate(double seconds);

}  // namespace porosph::bench
