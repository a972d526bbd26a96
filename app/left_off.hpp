// The state from which a run continues, or another begins.
#pragma once

#include <filesystem>

#include "app/staged_run.hpp"
#include "app/written_files.hpp"

namespace porosph::app {

struct LeftOff {
  RunProgress progress;
  WrittenFiles written;
  double wall_seconds = 0;

  void visit(StateArchive& state, StagedRun& run) {
    run.visit(state);
    progress.visit(state);
    written.visit(state);
    state.value("wall_seconds", wall_seconds);
  }
};

/// The last state of the run in a folder, which has come to its end or was interrupted. Throws UsageError
/// where there is none, ReadError where it cannot be read.
HandedOver last_state(const std::filesystem::path& folder);

}  // namespace porosph::app
