// What runs found when they held themselves against finite elements, as a part of a report.
#pragma once

#include <string>
#include <vector>

#include "solver/output/frame.hpp"

namespace porosph::render {

/// A table per run, headed by its label, or why it was not compared; empty where no run says anything.
std::string fem_check_section(const std::vector<std::string>& labels, const std::vector<Summary>& summaries);

}  // namespace porosph::render
