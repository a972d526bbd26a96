#include "solver/space/place_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace porosph {

std::string coordinate_text(double x) {
  if (std::abs(x) < 1000) return fmt::format("{:.6g}", x);
  std::string text = fmt::format("{:.3f}", x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string place_text(const Vec2& place) {
  return "(" + coordinate_text(place.x()) + ", " + coordinate_text(place.y()) + ")";
}

}  // namespace porosph
