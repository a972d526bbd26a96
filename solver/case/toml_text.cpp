#include "solver/case/toml_text.hpp"

#include <toml++/toml.h>

#include <cmath>
#include <sstream>

namespace porosph {

std::string toml_text(const std::string& text) {
  std::ostringstream out;
  const toml::value<std::string> value(text);
  out << toml::toml_formatter(value, toml::format_flags::none);
  return out.str();
}

std::string toml_text(double value) {
  return value == 0 && std::signbit(value) ? "-0.0" : fmt::format("{}", value);  // "-0" is a whole number
}

std::string toml_text(const Point& p) { return fmt::format("[{}, {}]", toml_text(p.x()), toml_text(p.y())); }

}  // namespace porosph
