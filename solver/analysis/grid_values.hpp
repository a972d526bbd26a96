// Values of a finished run on a regular grid.
#pragma once

#include "solver/analysis/frame_values.hpp"
#include "solver/case/case.hpp"

namespace porosph {

/// Nodes row by row from the lower left corner.
struct GridValues {
  Point low = Point::Zero();  ///< the first node [m]
  double spacing = 0;         ///< [m]
  int columns = 0, rows = 0;
  std::vector<bool> in_soil;  ///< of each node
  Frame values;               ///< points: those nodes that are in the soil, in their order; all fields there
};

/// The soil as it lies now, on a grid whose first node is the lower left corner of the box around it. Fields
/// are interpolated as along sections, up to outlines and on them. `fields`: what will be asked of the
/// values. Throws std::invalid_argument for a spacing that is not positive or a grid of more than 1e7 nodes,
/// and as soil_values.
GridValues values_on_grid(const Frame& frame, const Case* scene, double spacing,
                          const std::vector<FieldSelection>& fields);

}  // namespace porosph
