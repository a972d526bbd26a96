// Which faces drain excess pore pressure where the case names none.
#pragma once

#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// Faces of the excess head: nothing passes where a boundary holds the soil, and free stretches of the
/// outline drain (excess 0). Of the case's own faces, which hold where they overlap, a level counts from that
/// of the water that stands.
std::vector<HydraulicFaceCase> faces_of_excess(const Case&);

/// Faces of seepage: those of the case, which come last and hold where they overlap. Before them, over time:
/// nothing passes where a boundary holds the soil, and water may leave through free stretches of the outline.
std::vector<HydraulicFaceCase> faces_of_seepage(const Case&);

}  // namespace porosph
