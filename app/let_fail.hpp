// The runs that show how a slope fails whose factor of safety is known.
#pragma once

#include <filesystem>

#include "solver/run/strength_reduction.hpp"

namespace porosph::app {

/// Computes the case at rest into folder/rest, with its full strength or the largest that it rests with, and
/// from there its failure with the strength divided by `factor` (0: the smallest that it fails at), undamped,
/// into folder/runout, with a picture of it. Returns the exit status of the run that went wrong, or done.
/// Throws UsageError where no bracket was found, and what run_command throws.
int let_fail(const Case& scene, const StrengthReduction& found, double factor,
             const std::filesystem::path& folder, bool quiet);

}  // namespace porosph::app
