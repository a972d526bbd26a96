// The pictures and the page of sweeps.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "solver/sweep/sweep.hpp"
#include "solver/sweep/verdict.hpp"

namespace porosph::render {

/// A sweep and what came of it; empty where it was interrupted.
struct SweptMap {
  Sweep sweep;
  std::vector<std::optional<Verdict>> verdicts;
  std::vector<bool> usual_x, usual_y;  ///< values that are the case's own
};

/// Cells coloured by class, with the error or the time of breakdown in them. Throws std::runtime_error as
/// save_category_map.
void save_stability_map(const SweptMap& map, const std::filesystem::path& png);

/// index.html and study.json in `folder`, over `<sweep's name>.png` and `.csv`, which are there already.
/// Sections of other sweeps that the folder's study has are kept. `command` is the line that makes it.
/// Throws ReadError, WriteError.
void write_stability_study(const std::vector<SweptMap>& maps, const std::string& command,
                           const std::filesystem::path& folder);

}  // namespace porosph::render
