// The settings of cases as flat lists, to see in what they differ.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph::render {

/// Key and value of every setting, as "soil.0.youngs_modulus" and "15000000", in the order of the case file.
std::vector<std::pair<std::string, std::string>> settings_of(const Case& scene);

struct DifferingSetting {
  std::string key;
  std::vector<std::string> values;  ///< one per case; "" where a case has no such setting
};

/// Those that are not the same in all cases.
std::vector<DifferingSetting> differing_settings(const std::vector<Case>& scenes);

}  // namespace porosph::render
