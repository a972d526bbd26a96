#include "solver/case/local_origin.hpp"

#include <cmath>

namespace porosph {
namespace {

constexpr double near_enough = 1e4;  // m: positions then have 2e-12 m at least

void move(Polygon& polygon, const Point& by) {
  for (Point& p : polygon) p += by;
}

}  // namespace

Point local_origin(const Case& scene) {
  if (scene.plan) return local_origin(*scene.plan);  // the same in all stages
  Point low = Point::Constant(never), farthest = Point::Zero();
  for (const SoilCase& soil : scene.soils)
    for (const Point& p : soil.polygon) low = low.cwiseMin(p), farthest = farthest.cwiseMax(p.cwiseAbs());
  Point origin = Point::Zero();
  for (int axis = 0; axis < 2; ++axis)
    if (farthest[axis] > near_enough) origin[axis] = std::floor(low[axis]);
  return origin;
}

Case moved(Case scene, const Point& by) {
  if (by == Point::Zero()) return scene;
  for (SoilCase& soil : scene.soils) {
    move(soil.polygon, by);
    for (Polygon& hole : soil.holes) move(hole, by);
    soil.strength.level += by.y();  // infinite where it is the soil's highest point
  }
  for (WaterStretch& s : scene.water.stretches) s.x_from += by.x(), s.x_to += by.x(), s.level += by.y();
  for (Point& p : scene.water.level_over_time) p.y() += by.y();
  for (HydraulicFaceCase& face : scene.water.faces) face.from += by, face.to += by, face.level += by.y();
  for (HydraulicFaceCase& face : scene.water.faces)
    for (Point& p : face.level_over_time) p.y() += by.y();
  scene.water.transient.start_level += by.y();  // infinite where none is given
  for (DrainCase& drain : scene.water.drains) drain.from += by, drain.to += by, drain.level += by.y();
  for (FlowSectionCase& section : scene.sections) section.from += by, section.to += by;
  for (BoundaryCase& b : scene.boundaries) b.from += by, b.to += by;
  for (LoadCase& load : scene.loads) load.from += by, load.to += by;
  for (FootingCase& footing : scene.footings) footing.from += by, footing.to += by;
  for (SheetCase& sheet : scene.sheets) sheet.from += by, sheet.to += by;
  for (ProbeCase& probe : scene.probes) probe.position += by;
  return scene;
}

}  // namespace porosph
