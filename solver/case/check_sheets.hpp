// What the check of a case asks about sheets.
#pragma once

#include <vector>

#include "solver/case/check_case.hpp"

namespace porosph {

/// Where sheets are, what they go with, and what they are apart from. Outlines and boundaries must be right.
std::vector<CaseIssue> check_sheets(const Case&);

}  // namespace porosph
