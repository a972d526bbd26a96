// A case to fill in, from what was drawn.
#pragma once

#include <string>

#include "app/import/ground.hpp"

namespace porosph::drawn {

/// The spacing that gives about 2500 particles and at least two rows to each soil, as a round number [m].
double usual_spacing(const Ground& ground);

/// The case as TOML. Properties that no drawing holds have usual values, each line marked "FILL IN". Water of
/// one level everywhere stands still; water of several levels, or beside a part of the ground, flows steadily
/// between them. `source` is what was imported.
std::string case_of_ground(const Ground& ground, double spacing, const std::string& title,
                           const std::string& source);

}  // namespace porosph::drawn
