#include "solver/case/toml_text.hpp"

#include <toml++/toml.h>

#include <sstream>

namespace porosph {

std::string toml_text(const std::string& text) {
  std::ostringstream out;
  const toml::value<std::string> value(text);
  out << toml::toml_formatter(value, toml::format_flags::none);
  return out.str();
}

std::string toml_text(const Point& p) { return fmt::format("[{}, {}]", p.x(), p.y()); }

}  // namespace porosph
