// Sheets at one instant, for looking at.
#pragma once

#include <vector>

#include "solver/output/frame.hpp"
#include "solver/run/simulation.hpp"

namespace porosph {

/// Those that are there, in the case's coordinates.
std::vector<SheetFrame> make_sheet_frames(Simulation& simulation);

/// The largest of what each carries, by size.
std::map<std::string, Summary::Sheet> sheet_readings(Simulation& simulation);

}  // namespace porosph
