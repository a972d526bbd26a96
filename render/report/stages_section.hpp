// The part of a report that tells how each stage of a run went.
#pragma once

#include <string>
#include <vector>

#include "solver/output/frame.hpp"

namespace porosph::render {

/// Empty where no run has stages.
std::string stages_section(const std::vector<std::string>& labels, const std::vector<Summary>& summaries);

}  // namespace porosph::render
