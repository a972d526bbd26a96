// Which faces drain excess pore pressure where the case names none.
#pragma once

#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// Faces of the excess head: nothing passes where a boundary holds the soil, and free stretches of the
/// outline drain (excess 0). Of the case's own faces, which hold where they overlap, a level counts from that
/// of the water that stands.
std::vector<HydraulicFaceCase> faces_of_excess(const Case&);

}  // namespace porosph
