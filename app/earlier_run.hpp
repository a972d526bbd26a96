// Resuming a run to a later end time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "solver/case/case.hpp"

namespace porosph::app {

/// Where the folder holds a run of this case, gives `scene` the time step of that run, unless it names one
/// itself: the steps of a run that continues do not change. If that run ends earlier, returns its case as
/// text. Throws UsageError where it ends later.
std::optional<std::string> adopt_earlier_run(const std::filesystem::path& folder, Case& scene);

}  // namespace porosph::app
