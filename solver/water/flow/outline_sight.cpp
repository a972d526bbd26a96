#include "solver/water/flow/outline_sight.hpp"

#include <cmath>

namespace porosph {
namespace {

/// Both ends of the edge lie on the line of the wall.
bool on_line(const SoilOutlines::Edge& edge, const Wall& wall, double tolerance) {
  return std::abs(wall.distance(edge.a)) < tolerance && std::abs(wall.distance(edge.b)) < tolerance;
}

/// Where a ghost was at the start.
Vec2 start_of(std::size_t ghost, const Ghosts& ghosts, const Particles& p) {
  const Vec2 parent = ghosts.stems_from_ghost(ghost)
                          ? start_of(ghosts.parent(ghost) - ghosts.particles(), ghosts, p)
                          : p.start[ghosts.parent(ghost)];
  return ghosts.wall(ghost).mirrored(parent);
}

}  // namespace

/// Behind a corner of more than a right angle, ghosts of ghosts lie where a single wall has ghosts already.
bool OutlineSight::is_image_in_one_wall(const Vec2& start, std::size_t ghost, const Ghosts& ghosts) const {
  const auto covers = [&](const Wall& wall) {
    const Vec2 source = wall.mirrored(start);
    return wall.faces(source, range_) && outlines_.in_soil(source);
  };
  const std::size_t parent = ghosts.parent(ghost) - ghosts.particles();
  return covers(ghosts.wall(ghost)) || covers(ghosts.wall(parent));
}

bool OutlineSight::sees_ghost(std::int32_t a, std::size_t ghost, const Ghosts& ghosts,
                              const Particles& p) const {
  const Vec2 start = start_of(ghost, ghosts, p);
  if (ghosts.stems_from_ghost(ghost) && is_image_in_one_wall(start, ghost, ghosts)) return false;
  const SoilOutlines::Exit way_out = outlines_.exit(p.start[a], start);
  for (std::size_t g = ghost;; g = ghosts.parent(g) - ghosts.particles()) {
    for (const SoilOutlines::Edge* edge : way_out.out)
      if (on_line(*edge, ghosts.wall(g), 1e-3 * spacing_)) return true;
    if (!ghosts.stems_from_ghost(g)) return false;
  }
}

}  // namespace porosph
