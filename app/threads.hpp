// How many threads compute.
#pragma once

#include <cstddef>

namespace porosph::app {

/// As many as `wanted`, or with 0 as many cores as so many particles keep busy.
void use_threads(int wanted, std::size_t particles);

}  // namespace porosph::app
