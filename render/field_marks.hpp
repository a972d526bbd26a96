// Isolines with their labels, arrows and crosses of principal stress on a field.
#pragma once

#include <span>
#include <vector>

#include "render/axes.hpp"
#include "render/bands.hpp"
#include "render/scenery.hpp"
#include "solver/space/tensor.hpp"

namespace porosph::render {

/// Lines on which the field has the levels, each with its label where there is room beside the others and the
/// boxes that are `taken`; zero is drawn heavier.
void draw_isolines(Canvas& canvas, const Box& frame, const TriangleField& field,
                   std::span<const double> levels, std::vector<Box> taken);

/// Arrows at particles about `mark_spacing` apart, the longest of them that long [any unit].
void draw_arrows(Canvas& canvas, const Plot& plot, const std::vector<Point>& at,
                 const std::vector<Point>& vectors);

/// Crosses at particles about as far apart: lines along the principal directions in the plane, as long as the
/// stress is large, dark blue in compression, red in tension.
void draw_crosses(Canvas& canvas, const Plot& plot, const std::vector<Point>& at,
                  const std::vector<Stress>& stresses);

inline constexpr double mark_spacing = 34;  ///< [pixels]

/// Outlines, dashed.
void draw_outlines_before(Canvas& canvas, const Plot& plot, const std::vector<SoilOutline>& soils);

}  // namespace porosph::render
