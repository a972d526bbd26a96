// Whether the parts of a case fit each other.
#pragma once

#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// One thing that does not fit, at the key (full path, as "soil[0].polygon") that has to change.
struct CaseIssue {
  std::string key, message;
};

/// Names given twice, and amounts of output nobody can want. Needs values within their ranges, no geometry.
std::vector<CaseIssue> check_settings(const Case&);

/// Outlines, soils, water, boundaries and probes; whether particles and steps are as many as can be computed.
std::vector<CaseIssue> check_geometry(const Case&);

}  // namespace porosph
