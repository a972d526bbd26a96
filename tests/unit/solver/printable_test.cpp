#include "solver/printable.hpp"

#include <catch2/catch.hpp>

using namespace porosph;

TEST_CASE("text of people is shown as it is", "[printable]") {
  for (const std::string text : {"", "Slope under water", "Böschung σ'yy – 堤防 🏔", "a\\x1b[31m"}) {
    CHECK(control_character(text).empty());
    CHECK(printable(text) == text);
    CHECK(printable_lines(text) == text);
  }
}

TEST_CASE("what a terminal obeys, or what hides text, is named", "[printable]") {
  const auto [text, name] = GENERATE(table<std::string, std::string>({
      {"\x1b[2J", "U+001B"},
      {"\x1b]0;title\x07", "U+001B"},
      {"\r", "U+000D"},
      {"\x7f", "U+007F"},
      {"\xc2\x9b"
       "31m",
       "U+009B"},                  // the C1 form of ESC [
      {"\xe2\x80\xae", "U+202E"},  // writes to the left from here on
      {"\xe2\x81\xa6", "U+2066"},
      {"\xe2\x80\xa8", "U+2028"},
      {"\x9b", "byte 0x9B"},      // not UTF-8: some terminals obey it all the same
      {"\xc0\x9b", "byte 0xC0"},  // too long a form of U+001B
      {"\xe0\x80\x9b", "byte 0xE0"},
      {"\xe2\x80", "byte 0xE2"},  // cut short
  }));
  CAPTURE(name);
  CHECK(control_character("before " + text) == name);
  CHECK(printable("before " + text).starts_with("before [" + name + "]"));
  CHECK(control_character(printable("before " + text + " after")).empty());
  CHECK(printable("before " + text + " after").ends_with(" after"));
}

TEST_CASE("line breaks stay where lines are wanted", "[printable]") {
  CHECK(printable("a\nb") == "a[U+000A]b");
  CHECK(printable_lines("a\nb\x1b") == "a\nb[U+001B]");
}
