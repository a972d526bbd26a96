#include "solver/sph/paper/fixed_walls.hpp"

#include <algorithm>

#include "solver/boundary/wall.hpp"

namespace porosph {

FixedWalls::FixedWalls(const Model& model, double reach) : model_(model), kernel_(model.smoothing_length) {
  const auto& walls = model.walls;
  count_ =
      std::count_if(walls.begin(), walls.end(), [](const Wall& w) { return w.support().carries_shear(); });
  const Particles& p = model.particles;
  const std::size_t n = p.size();
  std::vector<Vec2> points = p.position;
  std::vector<Image> images;
  append_images(walls, 0, count_, reach, points, images);
  const std::size_t in_fixed = images.size();
  points_.assign(points.begin() + static_cast<std::ptrdiff_t>(n), points.end());
  std::vector<Image> in_rollers;
  append_images(walls, count_, walls.size(), reach, points_, in_rollers);
  for (const Image& i : in_rollers) images.push_back({i.parent + static_cast<std::int32_t>(n), i.wall});

  const std::vector<std::int32_t> root = roots(images, n);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::size_t parent = images[i].parent;
    volume_.push_back(parent < n ? p.volume(parent) : volume_[parent - n]);
    wall_.push_back(i < in_fixed ? images[i].wall : wall_[parent - n]);
    pressure_.push_back(model.water.pore_pressure(p.position[root[i]].x(), points_[i].y()));
  }
  if (std::ranges::any_of(model.soils, &Soil::flows)) continue_along_walls(reach);
}

/// Rows a spacing apart, but for where soil or an image lies.
void FixedWalls::continue_along_walls(double reach) {
  const double dx = model_.spacing;
  std::vector<Vec2> taken = points_;
  taken.insert(taken.end(), model_.particles.position.begin(), model_.particles.position.end());
  for (std::size_t w = 0; w < count_; ++w) {
    const Wall& wall = model_.walls[w];
    const double length = (wall.to - wall.from).norm();
    const Vec2 along = (wall.to - wall.from) / length;
    std::vector<Vec2> rows;
    for (double s = 0.5 * dx; s < length; s += dx)
      for (double depth = 0.5 * dx; depth < reach; depth += dx)
        rows.push_back(wall.from + s * along - depth * wall.normal);
    const NeighbourList near = find_neighbours(rows, taken, 0.75 * dx);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!near.of(i).empty()) continue;
      points_.push_back(rows[i]);
      volume_.push_back(dx * dx);
      wall_.push_back(static_cast<std::int32_t>(w));
      pressure_.push_back(model_.water.pore_pressure(rows[i].x(), rows[i].y()));
    }
  }
}

void FixedWalls::search(std::span<const Vec2> positions, double reach) {
  neighbours_ = find_neighbours(positions, points_, reach);
  gradient_.resize(neighbours_.index.size());
  stickiness_.resize(neighbours_.index.size());
  for (auto& v : velocity_) v.assign(positions.size(), 0);
  sums_.assign(positions.size(), {});  // most particles are far from walls
}

Mat2 FixedWalls::make_gradients(std::size_t a, const Vec2& place) {
  Mat2 moment = Mat2::Zero();
  for (std::int64_t k = neighbours_.begin[a]; k < neighbours_.begin[a + 1]; ++k) {
    const std::int32_t b = neighbours_.index[k];
    const Vec2 to_b = points_[b] - place;
    gradient_[k] = -volume_[b] * kernel_.slope(to_b.norm()) * to_b;
    moment += gradient_[k] * to_b.transpose();
  }
  return moment;
}

void FixedWalls::correct(std::size_t a, const Vec2& place, const Mat2& correction) {
  Sums sums;
  Vec2 velocity = Vec2::Zero();
  for (std::int64_t k = neighbours_.begin[a]; k < neighbours_.begin[a + 1]; ++k) {
    const std::int32_t b = neighbours_.index[k];
    const Wall& wall = model_.walls[wall_[b]];
    const Vec2 g = gradient_[k] = correction * Vec2(gradient_[k]);
    const double mine = wall.distance(place), its = -wall.distance(points_[b]);
    stickiness_[k] = 1 + (its < 0.5 * mine ? its / mine : 0.5);
    sums.gradient += g;
    velocity += stickiness_[k] * g;
    sums.pressure += pressure_[b] * g;
  }
  sums_[a] = sums;
  velocity_[0][a] = velocity.x(), velocity_[1][a] = velocity.y();
}

}  // namespace porosph
