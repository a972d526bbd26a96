// How a run of a sweep ended.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace porosph {

enum class StabilityClass {
  accurate,     ///< at rest, with an error below the limit
  inaccurate,   ///< at rest at another stress
  not_settled,  ///< still moving at the end
  unstable,     ///< broke down
  thrown_out,   ///< particles left the soil body
  refused,      ///< no valid case
};
inline constexpr int stability_classes = 6;

std::string_view class_name(StabilityClass c);  ///< "not settled"

struct Verdict {
  StabilityClass outcome = StabilityClass::refused;
  std::string cause;         ///< of the breakdown, one or two words; else empty
  double time = 0;           ///< of the breakdown or the end [s]
  std::int64_t steps = 0;    ///< until then
  double error = 0;          ///< relative L2 of the vertical effective stress; NaN where there is none
  double unbalanced = 0;     ///< unbalanced force ratio at the end; NaN after a breakdown
  double energy_growth = 0;  ///< as in Summary
  std::string message;       ///< of the breakdown or the refusal
};

}  // namespace porosph
