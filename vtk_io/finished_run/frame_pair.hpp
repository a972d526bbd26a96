// Which frames of two runs stand side by side: those of one time.
#pragma once

#include "vtk_io/finished_run/finished_run.hpp"

namespace porosph {

/// Numbers of frames of two runs.
struct FramePair {
  std::size_t a = 0, b = 0;
};

FramePair last_frames(const FinishedRun& a, const FinishedRun& b);

/// Those nearest to `time` [s]. Throws as frame_at.
FramePair frames_at(const FinishedRun& a, const FinishedRun& b, double time);

/// Those of the last time that both runs have, within a time step. Throws std::runtime_error, with the output
/// time to ask for, if that is the start.
FramePair common_frames(const FinishedRun& a, const FinishedRun& b);

/// Whether the two states may be held against each other: their times differ by no more than a time step, or
/// one of them is a run's last and at rest.
bool is_fair(const FinishedRun& a, const FinishedRun& b, const FramePair& frames);

/// Throws std::runtime_error, naming both times and what to do, unless is_fair.
void require_fair(const FinishedRun& a, const FinishedRun& b, const FramePair& frames);

}  // namespace porosph
