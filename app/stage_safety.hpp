// The factor of safety of a stage of a run.
#pragma once

#include <filesystem>

#include "app/staged_run.hpp"

namespace porosph::app {

/// Of the state in which the present stage has ended, with its files in `folder`/safety_<stage>. Where the
/// search cannot be done the note says why, and the run continues. Trials are the same however many cores
/// there are. Throws WriteError. An interruption leaves no files.
Summary::Safety find_stage_safety(StagedRun& stages, const std::filesystem::path& folder, bool quiet);

}  // namespace porosph::app
