#include "app/colour.hpp"

#include <fmt/color.h>
#include <unistd.h>

#include <cstdlib>

namespace porosph::app {
namespace {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool takes_colours(std::FILE* stream) {
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal != nullptr && std::string_view(terminal) == "dumb";
  return isatty(fileno(stream)) != 0 && !is_set("NO_COLOR") && !dumb;
}

fmt::text_style look(Style style) {
  switch (style) {
    case Style::heading:
      return fmt::emphasis::bold;
    case Style::good:
      return fg(fmt::terminal_color::green);
    case Style::warning:
      return fg(fmt::terminal_color::yellow);
    case Style::error:
      return fmt::emphasis::bold | fg(fmt::terminal_color::red);
  }
  return {};
}

}  // namespace

std::string styled(std::FILE* stream, Style style, std::string_view text) {
  return takes_colours(stream) ? fmt::format(look(style), "{}", text) : std::string(text);
}

}  // namespace porosph::app
