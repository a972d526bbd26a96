// The comparison with finite elements as a part of summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "solver/output/fem_check.hpp"

namespace porosph {

/// Numbers that are not finite are null, with a reason beside them.
nlohmann::ordered_json to_json(const FemCheck&);

/// Throws nlohmann::json::exception where it is not what to_json() makes.
FemCheck fem_check_from(const nlohmann::ordered_json&);

}  // namespace porosph
