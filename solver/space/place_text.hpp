// Places as messages tell them.
#pragma once

#include <string>

#include "solver/space/tensor.hpp"

namespace porosph {

/// Six digits, and millimetres at least, so that places far from the origin can be told apart.
std::string coordinate_text(double x);
/// "(x, y)", of such coordinates.
std::string place_text(const Vec2& place);

}  // namespace porosph
