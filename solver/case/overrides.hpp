// Values that replace those of a case file.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "solver/case/report.hpp"

namespace porosph {

/// Puts "key=value" overrides into the table and returns where they went. Each that cannot be understood adds
/// a line to `errors`.
std::vector<Override> apply_overrides(toml::table& root, const std::vector<std::string>& overrides,
                                      std::vector<std::string>& errors);

}  // namespace porosph
