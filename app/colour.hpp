// Colours for people at a terminal.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace porosph::app {

enum class Style { heading, good, warning, error };

/// The text for `stream` (stdout or stderr): in colour on a terminal, plain elsewhere, with NO_COLOR set
/// (no-color.org) and on a TERM=dumb.
std::string styled(std::FILE* stream, Style style, std::string_view text);

}  // namespace porosph::app
