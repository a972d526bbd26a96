// Other settings for a case that has been read.
#pragma once

#include "solver/case/check_case.hpp"

namespace porosph {

/// What is wrong with one of the settings, by its place among them; -1: with what they make together.
struct SettingFault {
  int setting = -1;
  std::string message;
};

/// The case with "key=value" settings applied, as overrides are. One way to give the water its level takes
/// the place of another. The case has no stages. Where `faults` comes back with any the case is of no use.
Case with_settings(const Case& scene, const std::vector<std::string>& settings,
                   std::vector<SettingFault>& faults);

}  // namespace porosph
