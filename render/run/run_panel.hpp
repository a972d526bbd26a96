// The particles of a run as a panel of a contour picture, with what its case says stands around them.
#pragma once

#include "render/contour.hpp"
#include "render/run/shown_field.hpp"
#include "vtk_io/finished_run/finished_run.hpp"

namespace porosph::render {

/// Outlines, water, supports and probes of the case.
Scenery scenery_of(const Case& scene);
/// The same with the water as it stands at that time [s].
Scenery scenery_at(const Case& scene, double time);

/// A panel without titles. `values`: one per particle, as they are shown. `deformation`: 1 draws the
/// particles where they are, 0 where they were at the start, other values exaggerate (needs Displacement in
/// the frame; throws std::runtime_error without). Unless it is 1, outlines and probes move along with the
/// soil, while supports and water stay where they are.
ContourPanel panel_of(const FinishedRun& run, const Frame& frame, std::vector<double> values,
                      double deformation = 1, FieldStyle style = FieldStyle::particles);

/// Adds the values on triangles, for the styles that need them. `starts`: the particles at t = 0,
/// `positions`: now, `drawn`: where the picture has them [m]. Without a case the soil ends at the outermost
/// particles.
void add_smooth_field(ContourPanel& panel, const Case* scene, const std::vector<Point>& starts,
                      const std::vector<Point>& positions, const std::vector<Point>& drawn);

/// Moves a panel's outlines, probes and cells by `factor` times the particles' `displacements`, which are
/// theirs from `starts` [m]; its positions are left alone.
void deform_surroundings(ContourPanel& panel, const Case& scene, const std::vector<Point>& starts,
                         const std::vector<Point>& displacements, double factor);

/// Side of the square that a particle stands for: the case's spacing, else from mass and density, else the
/// usual distance to the next particle [m].
std::vector<double> particle_sizes(const FinishedRun& run, const Frame& frame);

/// particle_cells, a little enlarged as the squares are.
std::vector<Polygon> drawn_cells(const Case& scene, const std::vector<Point>& starts);

/// A range for the values of several runs, or of several instants of one: rounded, or centred at zero for a
/// diverging map. Without single spots and, of three or more runs, without those that go far beyond the
/// others.
ValueRange range_of_runs(const std::vector<std::vector<double>>& values, ColourMap map);
ValueRange range_of_instants(const std::vector<ValueRange>& robust_extents, ColourMap map);

/// Label, map and, for the soils' numbers, their names. `range`: as the colours have it; with `usual` of a
/// field that is usually logarithmic, the three decades below its end.
ColourScale scale_of(const FieldSelection& field, const ShownUnit& unit, const std::optional<Case>& scene,
                     std::optional<ValueRange> range, bool usual = false);

/// Three decades up to the range's high end, with logarithmic colours; as it is where that is not positive.
void make_logarithmic(ColourScale& scale);

/// "t = 1.25 s".
std::string time_text(double time);

/// "t = 1.25 s, proposed, without kernel correction, undamped": without what `title` says already; with
/// ", unstable" where the run ended so. Only the time without a case.
std::string panel_subtitle(const FinishedRun& run, double time, const std::string& title);

}  // namespace porosph::render
