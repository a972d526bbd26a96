// Whether a case fits into this machine.
#pragma once

#include "solver/case/case.hpp"

namespace porosph::app {

/// Memory of the machine, or of the container's share of it [bytes].
double memory_here();

/// Throws std::runtime_error that says how much a case needs and how much there is, where that is too little.
void check_memory(const Case& scene);

}  // namespace porosph::app
