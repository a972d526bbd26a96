// What stands around the particles in a contour picture: outlines, water, supports, probes.
#pragma once

#include <string>
#include <vector>

#include "render/axes.hpp"
#include "solver/case/case.hpp"

namespace porosph::render {

struct SoilOutline {
  Polygon polygon;
  std::vector<Polygon> holes;
};

/// A line through the soil, such as a slip surface.
struct SceneryLine {
  std::vector<Point> points;  ///< [m]
  std::string label;          ///< in the legend
  Colour colour;
};

/// A sheet where it is drawn, and the bending moment at its points.
struct DrawnSheet {
  std::vector<Point> points;  ///< [m]
  std::vector<double>
      moments;  ///< per metre of thickness, positive where its left side is concave [N]; or empty
};

struct Scenery {
  std::vector<SoilOutline> soils;          ///< [m]
  std::vector<WaterStretch> water;         ///< [m]
  std::vector<BoundaryCase> boundaries;    ///< [m]
  std::vector<ProbeCase> probes;           ///< [m]
  std::vector<LoadCase> loads = {};        ///< as at the end of the case
  std::vector<FootingCase> footings = {};  ///< drawn where they were placed
  std::vector<DrawnSheet> sheets = {};
  std::vector<SceneryLine> lines = {};
  std::vector<std::vector<Point>> water_table = {};  ///< lines in the soil [m]
};

struct Interval {
  double from = 0, to = 0;
  double length() const { return to - from; }
};

/// The parts of the horizontal line at `y` between `x_from` and `x_to` that lie inside the soils (or outside
/// of them).
std::vector<Interval> soil_intervals(const std::vector<SoilOutline>& soils, double y, double x_from,
                                     double x_to);
std::vector<Interval> free_intervals(const std::vector<SoilOutline>& soils, double y, double x_from,
                                     double x_to);

bool inside_soil(const std::vector<SoilOutline>& soils, Point point);

/// Where draw_scenery puts probes and their names.
std::vector<Box> probe_boxes(const Plot& plot, const Scenery& scenery);

/// Soil outlines, water level with its triangle, supports on the side away from the soil, loads, footings,
/// sheets with their moment diagrams, probes, further lines with a legend where it hides none of them. Lines
/// only: water is filled beneath the particles. Water is drawn from `x_from` to `x_to` at most.
void draw_scenery(Canvas& canvas, const Plot& plot, const Scenery& scenery, double x_from, double x_to);

}  // namespace porosph::render
