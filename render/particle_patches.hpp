// Particles, and the water above the soil, as coloured cells.
#pragma once

#include <vector>

#include "render/axes.hpp"
#include "render/patches.hpp"
#include "solver/case/case.hpp"

namespace porosph::render {

/// A square of side `sizes` [m] (one value for all, or one each), or the cell of that particle where `cells`
/// has one, with one colour per particle. Particles whose centre is outside of the plot's box are left out.
Patches particle_patches(const Plot& plot, const std::vector<Point>& positions,
                         const std::vector<double>& sizes, const std::vector<Polygon>& cells,
                         const std::vector<Colour>& colours);

/// Light fill from each water level down to the height `bottom`, from `x_from` to `x_to` at most [m].
Patches water_patches(const Plot& plot, const std::vector<WaterStretch>& water, double x_from, double x_to,
                      double bottom);

}  // namespace porosph::render
