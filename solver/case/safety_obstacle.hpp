// Whether a case has a factor of safety.
#pragma once

#include <string>

#include "solver/case/case.hpp"

namespace porosph {

/// Why strength reduction has no answer for a case, or for one stage of a case; empty where it has.
std::string safety_obstacle(const Case& scene);

/// The same for limit equilibrium, which knows less.
std::string limit_equilibrium_obstacle(const Case& scene);

}  // namespace porosph
