// Whether a case with stages can be followed through them.
#pragma once

#include "solver/case/check_case.hpp"

namespace porosph {

/// What is wrong with a case that has stages, or with a stage, before the run: geometry as check_geometry()
/// sees it, in each stage with what is there then.
std::vector<CaseIssue> check_stages(const Case& scene);

}  // namespace porosph
