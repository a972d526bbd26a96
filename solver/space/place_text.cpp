#include "solver/space/place_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace porosph {
namespace {

std::string coordinate(double x) {
  if (std::abs(x) < 1000) return fmt::format("{:.6g}", x);
  std::string text = fmt::format("{:.3f}", x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

std::string place_text(const Vec2& place) {
  return "(" + coordinate(place.x()) + ", " + coordinate(place.y()) + ")";
}

}  // namespace porosph
