// Whether linear finite elements answer the question that a case asks.
#pragma once

#include <string>

#include "solver/case/case.hpp"

namespace porosph {

/// Why the state of rest of a case is not that of linear finite elements, loaded in one step from an
/// unstressed soil; empty where it is.
std::string fem_obstacle(const Case&);

}  // namespace porosph
