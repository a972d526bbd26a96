// Words on the terminal during a computation.
#pragma once

#include <cstdio>
#include <string>

namespace porosph::app {

/// Writes text at once. Nothing happens where it cannot be written: a terminal that closed or a pipe that
/// nobody reads must not end a run (fmt::print would throw).
inline void say(std::FILE* stream, const std::string& text) {
  std::fputs(text.c_str(), stream);
  std::fflush(stream);
}

}  // namespace porosph::app
