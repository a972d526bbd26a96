// Whether periodic sides, and a base that shakes, go with the rest of a case.
#pragma once

#include <vector>

#include "solver/case/check_case.hpp"

namespace porosph {

/// What periodic boundaries and [shaking] cannot be combined with; in any outlines.
std::vector<CaseIssue> check_sides_settings(const Case& scene);

/// Whether periodic boundaries are a pair of upright sides of level layers; needs sound outlines.
std::vector<CaseIssue> check_periodic_sides(const Case& scene);

}  // namespace porosph
