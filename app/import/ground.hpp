// What the shapes of a drawing mean: soils, supports, water and probes.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/import/drawing.hpp"
#include "app/import/regions_of_lines.hpp"

namespace porosph::drawn {

enum class Role { soil, water, probe, roller, fixed, nothing };

struct Options {
  std::map<std::string, Role> roles;  ///< by layer, for those whose names do not tell
  double metres = 1;                  ///< one unit of the drawing [m]
  double snap = 1e-3;                 ///< points nearer than this are one [m]
  std::vector<Label> names;           ///< of regions between lines, by a point in each; "": no soil there
  std::filesystem::path reader;       ///< the program that joins lines to regions
};

/// A surface of standing water.
struct WaterLine {
  double x_from = 0, x_to = 0, level = 0;  ///< [m]
};

/// A water table that reaches an end of the section within the soil.
struct EndLevel {
  bool is_left = true;
  double level = 0;  ///< [m]
};

/// A straight part of the outline of all soils.
enum class Side { base, flank, surface };
struct Stretch {
  Side side = Side::surface;
  Point from = Point::Zero(), to = Point::Zero();  ///< soil on the left [m]
};

struct Ground {
  std::vector<SoilCase> soils;  ///< names, polygons and holes
  std::vector<Stretch> outline;
  std::vector<BoundaryCase> supports;  ///< as drawn; empty: none was
  std::vector<WaterLine> water;
  std::vector<EndLevel> end_levels;
  std::vector<ProbeCase> probes;
  std::vector<std::string> notes;  ///< what was left out, and what was made fit, for people
};

/// A layer whose name begins with water, probe, roller or fixed is that, any other one is a soil.
Role role_of(const std::string& layer, const Options& options);

/// Soils are closed shapes, named by their layers, or the regions that lines enclose (regions_of_lines.hpp);
/// their corners and edges are made to meet within `snap`, and a soil inside another is a hole of that. Water
/// lines are level, or the closed outline of the water, or a water table that falls within the soil, which
/// then flows between the levels at its ends. Throws DrawingError where no soil is drawn, water falls above
/// the ground, nothing drives the flow, or an option names a layer that is not there.
Ground ground_of(const Drawing& drawing, const Options& options);

}  // namespace porosph::drawn
