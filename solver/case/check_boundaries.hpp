// Whether boundaries lie on the soils' outlines and meet each other properly.
#pragma once

#include <vector>

#include "solver/case/check_case.hpp"

namespace porosph {

/// Issues of the boundaries, and of soils that none of them carries. Needs sound outlines.
std::vector<CaseIssue> check_boundaries(const Case&);

/// Whether there is soil beside any part of it.
bool lies_on_soil(const Case&, const BoundaryCase&);

}  // namespace porosph
