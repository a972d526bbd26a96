// Settings that the stability maps (docs/stability.md) show to fail.
#pragma once

#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// One warning for each setting of the case that is known to fail: which, what happens, what to choose
/// instead. Empty for all else; the absence of a warning promises nothing.
std::vector<std::string> known_failures(const Case& scene);

}  // namespace porosph
