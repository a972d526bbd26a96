// Whether boundaries lie on the soils' outlines and meet each other properly.
#pragma once

#include <vector>

#include "solver/case/check_case.hpp"

namespace porosph {

/// Issues of the boundaries, and of soils that none of them carries. Needs sound outlines.
std::vector<CaseIssue> check_boundaries(const Case&);

/// Of each soil, whether it falls onto another: gravity acts, no boundary carries the body that it belongs to,
/// and soil of another lies below. Needs sound outlines.
std::vector<bool> falling_soils(const Case&);

/// Whether there is soil beside any part of it.
bool lies_on_soil(const Case&, const BoundaryCase&);

}  // namespace porosph
