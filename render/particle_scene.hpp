// Particles, and the water above the soil, as one VTK scene.
#pragma once

#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "render/axes.hpp"
#include "solver/case/case.hpp"

namespace porosph {

/// More particles than this are drawn as square GL points of a whole number of device pixels, which is
/// faster.
inline constexpr std::size_t most_quads = 500'000;

/// A square of side `sizes` [m] (one value for all, or one each), or the cell of that particle where `cells`
/// has one, with one colour per particle, in pixels from the lower left corner of the plot's box. Particles
/// whose centre is outside of the box are left out.
vtkSmartPointer<vtkProp> particle_scene(const Plot& plot, const std::vector<Point>& positions,
                                        const std::vector<double>& sizes, const std::vector<Polygon>& cells,
                                        const std::vector<Colour>& colours);

/// Light fill from each water level down to the height `bottom`, from `x_from` to `x_to` at most [m].
vtkSmartPointer<vtkProp> water_scene(const Plot& plot, const std::vector<WaterStretch>& water, double x_from,
                                     double x_to, double bottom);

}  // namespace porosph
