// Values of a case as TOML.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

std::string toml_text(const std::string& text);  ///< on one line, with escapes
std::string toml_text(const Point& point);
std::string toml_text(double value);  ///< all digits; a negative zero keeps its sign

template <class T>
std::string toml_text(const std::vector<T>& values) {
  std::string list;
  for (const T& value : values) list += (list.empty() ? "" : ", ") + toml_text(value);
  return fmt::format("[{}]", list);
}

}  // namespace porosph
