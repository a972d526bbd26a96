// What a run has written so far, to recognise it when the run is resumed.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/particles/state.hpp"

namespace porosph::app {

/// Checksums of the history's rows and of the frames, kept with each checkpoint.
struct WrittenFiles {
  std::uint32_t history = 0;          ///< of the column names and all rows, as text
  std::vector<std::uint32_t> frames;  ///< of each file of the series, in order

  /// Throws StateError.
  void visit(StateArchive& state) {
    constexpr std::int64_t most = 1 << 22;
    auto count = static_cast<std::int64_t>(frames.size());
    state.value("history_checksum", history);
    state.value("frame_files", count);
    if (count < 0 || count > most) throw StateError("the saved state has an impossible number of frames");
    frames.resize(static_cast<std::size_t>(count));
    state.array("frame_checksums", frames);
  }
};

}  // namespace porosph::app
