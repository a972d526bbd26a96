// What the check of a case asks about loads.
#pragma once

#include <vector>

#include "solver/case/check_case.hpp"

namespace porosph {

/// Whether each load presses on something, and lies on one straight free stretch of the outline. Outlines and
/// boundaries must be right.
std::vector<CaseIssue> check_loads(const Case&);
/// Of footings: where they are, what drives them, and what they cannot be combined with.
std::vector<CaseIssue> check_footings(const Case&);

/// Such soil flows around the footing's edge once it yields.
bool footing_on_soil_that_may_yield(const Case&);

}  // namespace porosph
