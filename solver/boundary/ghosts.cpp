#include "solver/boundary/ghosts.hpp"

#include <utility>

namespace porosph {

namespace {

std::vector<Image> images_of(std::span<const Wall> walls, std::size_t first, std::size_t last, double range,
                             std::vector<Vec2>& points) {
  std::vector<Image> images;
  append_images(walls, first, last, range, points, images);
  points.shrink_to_fit();  // of the whole body, and kept as long as the images are
  return images;
}

}  // namespace

Ghosts::Ghosts(std::span<const Wall> walls, std::size_t first, std::size_t last, double range,
               std::vector<Vec2>& points)
    : particles_(points.size()) {
  *this = Ghosts(walls, images_of(walls, first, last, range, points), particles_);
}

Ghosts::Ghosts(std::span<const Wall> walls, std::vector<Image> images, std::size_t particles)
    : walls_(walls), particles_(particles), images_(std::move(images)), root_(roots(images_, particles)) {
  for (const Wall& wall : walls) {
    reflection_.push_back(wall.reflection());
    motion_.push_back(wall.support().mirrored_motion(wall.normal));
  }
  for (std::size_t i = 0; i < size(); ++i)
    if (stems_from_ghost(i)) of_ghosts_.push_back(i);
}

}  // namespace porosph
