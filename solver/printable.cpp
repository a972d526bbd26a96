#include "solver/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace porosph {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool is_utf8 = true;
};

/// The character at the start of a text that is not empty.
Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {lead, 1, false};
  std::uint32_t code = lead & (0xFFu >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {lead, 1, false};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool is_overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  if (is_overlong) return {lead, 1, false};
  return {code, bytes, true};
}

bool is_control(const Character& c) {
  const bool changes_direction = (c.code >= 0x202A && c.code <= 0x202E) ||
                                 (c.code >= 0x2066 && c.code <= 0x2069) || c.code == 0x200E ||
                                 c.code == 0x200F;
  const bool breaks_line = c.code == 0x2028 || c.code == 0x2029;
  return !c.is_utf8 || c.code < 0x20 || (c.code >= 0x7F && c.code < 0xA0) || changes_direction || breaks_line;
}

std::string name_of(const Character& c) {
  return c.is_utf8 ? fmt::format("U+{:04X}", c.code) : fmt::format("byte 0x{:02X}", c.code);
}

std::string shown(std::string_view text, bool keep_lines) {
  std::string out;
  while (!text.empty()) {
    const Character c = first_of(text);
    if (is_control(c) && !(keep_lines && c.code == '\n'))
      out += "[" + name_of(c) + "]";
    else
      out += text.substr(0, c.bytes);
    text.remove_prefix(c.bytes);
  }
  return out;
}

}  // namespace

std::string control_character(std::string_view text) {
  while (!text.empty()) {
    const Character c = first_of(text);
    if (is_control(c)) return name_of(c);
    text.remove_prefix(c.bytes);
  }
  return "";
}

std::string printable(std::string_view text) { return shown(text, false); }

std::string printable_lines(std::string_view text) { return shown(text, true); }

}  // namespace porosph
