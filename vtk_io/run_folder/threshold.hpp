// Limits that a run has to keep, such as errors.EffectiveStress_YY.relative_l2>0.02.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace porosph {

struct Threshold {
  std::string text;  ///< as it was given
  std::string path;  ///< into summary.json, steps separated by dots
  enum class Relation { above, at_least, below, at_most } relation;
  double limit = 0;
};

/// "PATH>NUMBER", with >=, < and <= likewise: what is to count as failure. Throws std::runtime_error.
Threshold parse_threshold(const std::string& text);

struct ThresholdOutcome {
  bool failed = false;
  double value = 0;  ///< NaN where the summary holds null: that fails
};

/// Throws std::runtime_error where the summary has no such number, naming what it has at the step that is
/// missing.
ThresholdOutcome check(const Threshold& threshold, const nlohmann::ordered_json& summary);

}  // namespace porosph
