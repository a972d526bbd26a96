// Small scenes of seepage, and their solution on particles.
#pragma once

#include <memory>

#include "solver/model/model.hpp"
#include "solver/water/flow/steady_seepage.hpp"

namespace porosph::test {

/// A rectangle of one soil, the lower left corner in the origin, closed all around.
inline Case seepage_box(double width, double height, double spacing,
                        Arrangement arrangement = Arrangement::stretched) {
  Case scene;
  SoilCase soil;
  soil.name = "sand";
  soil.polygon = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  soil.youngs_modulus = 15e6;
  soil.poissons_ratio = 0.33;
  soil.unit_weight_saturated = 20e3;
  soil.unit_weight_unsaturated = 18e3;
  soil.permeability = {1e-5, 1e-5};
  scene.soils = {soil};
  scene.particles.spacing = spacing;
  scene.particles.arrangement = arrangement;
  scene.water.faces = {{}};
  return scene;
}

inline HydraulicFaceCase head_face(Point from, Point to, double level) {
  return {.kind = FaceKind::head, .from = from, .to = to, .level = level};
}

/// A case's steady flow on its particles.
struct Seepage {
  explicit Seepage(const Case& scene)
      : model(build_model(scene)),
        outline(hydraulic_outline(scene.soils, scene.water.faces, scene.particles.spacing)) {
    std::vector<Retention> retention;
    for (const SoilCase& s : scene.soils) retention.emplace_back(s.retention, scene.particles.spacing);
    std::vector<double> height;
    for (const Vec2& x : model.particles.position) height.push_back(x.y());
    flow = std::make_unique<DarcyFlow>(
        make_flow_pairs(scene.soils, outline, model.particles, scene.particles.spacing), outline, retention,
        model.particles.soil, height);
    solved = solve_steady(*flow, FaceConditions(outline, scene.water.faces),
                          start_of_steady(scene.water.faces, height));
    through = through_faces(*flow, outline, solved.head, solved.faces, scene.water.faces.size());
  }
  std::size_t size() const { return solved.head.size(); }
  Vec2 position(std::size_t a) const { return model.particles.position[a]; }
  double pressure_head(std::size_t a) const { return solved.head[a] - position(a).y(); }

  Model model;
  HydraulicOutline outline;
  std::unique_ptr<DarcyFlow> flow;
  SteadySeepage solved;
  std::vector<double> through;  ///< of each face [m2/s]
};

}  // namespace porosph::test
