#include "solver/sweep/verdict.hpp"

#include <array>

namespace porosph {

std::string_view class_name(StabilityClass c) {
  static constexpr std::array<std::string_view, stability_classes> names = {
      "accurate", "inaccurate", "not settled", "unstable", "thrown out", "refused"};
  return names[static_cast<std::size_t>(c)];
}

}  // namespace porosph
