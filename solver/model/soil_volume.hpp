// How much of each drawn soil its particles carry.
#pragma once

#include "solver/model/model.hpp"

namespace porosph {

/// Of one soil, per metre of thickness [m2].
struct SoilVolume {
  double drawn = 0;    ///< area of the polygon without its holes
  double carried = 0;  ///< sum of the particles' volumes
  double cells = 0;    ///< particles times spacing^2
  std::int64_t particles = 0;
};

/// One per soil. The model as it was built from the case.
std::vector<SoilVolume> soil_volumes(const Model& model, const Case& scene);

}  // namespace porosph
