// The particles of a run as a panel of a contour picture, with what its case says stands around them.
#pragma once

#include "render/contour.hpp"
#include "render/run/finished_run.hpp"

namespace porosph {

/// Outlines, water, supports and probes of the case.
Scenery scenery_of(const Case& scene);

/// A panel without titles. `values`: one per particle, as they are shown. `deformation`: 1 draws the
/// particles where they are, 0 where they were at the start, other values exaggerate (needs Displacement in
/// the frame; throws std::runtime_error without).
ContourPanel panel_of(const FinishedRun& run, const Frame& frame, std::vector<double> values,
                      double deformation = 1);

/// Side of the square that a particle stands for: the case's spacing, else from mass and density, else the
/// usual distance to the next particle [m].
std::vector<double> particle_sizes(const FinishedRun& run, const Frame& frame);

/// particle_cells, a little enlarged as the squares are.
std::vector<Polygon> drawn_cells(const Case& scene, const std::vector<Point>& starts);

/// The same extent for all of them, rounded, or centred at zero for a diverging map.
ValueRange shared_range(const std::vector<std::vector<double>>& values, ColourMap map);

/// "t = 1.25 s".
std::string time_text(double time);

/// "proposed, without kernel correction, undamped"; empty without a case.
std::string formulation_text(const FinishedRun& run);

}  // namespace porosph
