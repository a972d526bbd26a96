// Text that comes from files and is shown to people.
#pragma once

#include <string>
#include <string_view>

namespace porosph {

/// Names the first control character of a UTF-8 text, "U+001B": one of the C0 and C1 sets (a terminal may
/// obey them), or one that changes the direction of writing (what is shown is then not what is there). Empty
/// where there is none. Bytes that are not UTF-8 are named "byte 0x9B".
std::string control_character(std::string_view text);

/// The text with each of them replaced by its code in brackets, "[U+001B]".
std::string printable(std::string_view text);

/// As printable(), but line breaks stay.
std::string printable_lines(std::string_view text);

}  // namespace porosph
