#include "solver/output/boundary_frame.hpp"

#include <algorithm>

namespace porosph {
namespace {

struct Mirrored {
  std::vector<Vec2> points;
  std::vector<std::int32_t> wall, particle;
};

/// Appends the images of `sources` in walls `first` to `last - 1`, with the particle that each stems from.
void mirror(const Model& model, std::size_t first, std::size_t last, const std::vector<Vec2>& sources,
            const std::vector<std::int32_t>& particle_of, Mirrored& out) {
  std::vector<Vec2> points = sources;
  std::vector<Image> images;
  append_images(model.walls, first, last, 2 * model.smoothing_length, points, images);
  const std::vector<std::int32_t> root = roots(images, sources.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    out.points.push_back(points[sources.size() + i]);
    out.wall.push_back(images[i].wall);
    out.particle.push_back(particle_of[root[i]]);
  }
}

Mirrored mirrored(const Model& model, Motion motion) {
  const Particles& p = model.particles;
  const std::size_t walls = model.walls.size();
  Mirrored all;
  if (motion == Motion::consistent) {
    mirror(model, 0, walls, p.position, p.id, all);
    return all;
  }
  const std::size_t fixed = static_cast<std::size_t>(std::ranges::count(
      model.walls, true, [](const Wall& w) { return w.support().carries_shear(); }));  // they come first
  mirror(model, 0, fixed, p.start, p.id, all);
  const Mirrored behind_fixed = all;
  mirror(model, fixed, walls, behind_fixed.points, behind_fixed.particle, all);
  mirror(model, fixed, walls, p.position, p.id, all);
  return all;
}

std::int32_t boundary_of(const Case& scene, const Point& origin, const Wall& wall) {
  const auto found = std::ranges::find_if(scene.boundaries, [&](const BoundaryCase& b) {
    return b.kind == wall.kind && b.from - origin == wall.from && b.to - origin == wall.to;
  });
  return static_cast<std::int32_t>(found - scene.boundaries.begin());
}

}  // namespace

Frame make_boundary_frame(const Simulation& simulation) {
  const Model& model = simulation.model();
  const Mirrored all = mirrored(model, simulation.scene().formulation.motion);
  Frame frame;
  frame.step = simulation.step();
  frame.time = simulation.time();
  std::vector<std::int32_t> boundary, fixed;
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    frame.points.insert(frame.points.end(),
                        {all.points[i].x() + model.origin.x(), all.points[i].y() + model.origin.y(), 0.0});
    const Wall& wall = model.walls[all.wall[i]];
    boundary.push_back(boundary_of(simulation.scene(), model.origin, wall));
    fixed.push_back(wall.support().carries_shear());
  }
  frame.fields = {{"BoundaryId", {}, boundary}, {"Fixed", {}, fixed}, {"ParticleId", {}, all.particle}};
  return frame;
}

}  // namespace porosph
