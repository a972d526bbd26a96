#include "solver/boundary/ghosts.hpp"

namespace porosph {

Ghosts::Ghosts(std::span<const Wall> walls, std::size_t first, std::size_t last, double range,
               std::vector<Vec2>& points)
    : walls_(walls), particles_(points.size()) {
  for (const Wall& wall : walls) {
    reflection_.push_back(wall.reflection());
    motion_.push_back(wall.support().mirrored_motion(wall.normal));
  }
  append_images(walls, first, last, range, points, images_);
  root_ = roots(images_, particles_);
  for (std::size_t i = 0; i < images_.size(); ++i)
    if (stems_from_ghost(i)) of_ghosts_.push_back(i);
}

}  // namespace porosph
