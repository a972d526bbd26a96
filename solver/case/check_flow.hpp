// What a case that lets water flow needs.
#pragma once

#include "solver/case/check_case.hpp"

namespace porosph {

/// Settings that the mode of the water asks for, or that it does not use.
std::vector<CaseIssue> check_flow_settings(const Case&);
/// Faces against the outline of the soils, which are sound.
std::vector<CaseIssue> check_faces(const Case&);

}  // namespace porosph
