// How a run's end is called in its summary.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "solver/output/frame.hpp"

namespace porosph {

inline constexpr std::array<std::pair<RunStatus, std::string_view>, 4> run_status_names{{
    {RunStatus::completed, "completed"},
    {RunStatus::equilibrium, "equilibrium"},
    {RunStatus::unstable, "unstable"},
    {RunStatus::interrupted, "interrupted"},
}};

}  // namespace porosph
