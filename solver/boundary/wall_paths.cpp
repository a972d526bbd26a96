#include "solver/boundary/wall_paths.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {
namespace {

constexpr int most_turns = 9;  // behind a corner of 20 degrees

Vec2 direction(const Wall& wall) { return (wall.to - wall.from).normalized(); }

bool is_at(const Vec2& place, const Wall& wall, double tolerance) {
  const Vec2 line = wall.to - wall.from;
  const double along = std::clamp((place - wall.from).dot(line) / line.squaredNorm(), 0.0, 1.0);
  return (wall.from + along * line - place).norm() < tolerance;
}

}  // namespace

WallPaths::WallPaths(std::vector<Wall> walls, double range)
    : walls_(std::move(walls)), range_(range), slack_(1e-9 * range) {
  for (std::size_t w = 0; w < walls_.size(); ++w)
    ends_.push_back({end_of(w, walls_[w].from), end_of(w, walls_[w].to)});
}

WallPaths::End WallPaths::end_of(std::size_t w, const Vec2& at) const {
  End end{.at = at};
  for (std::size_t v = 0; v < walls_.size(); ++v) {
    if (v == w || !is_at(at, walls_[v], 1e-3 * range_)) continue;
    const double cosine = direction(walls_[w]).dot(direction(walls_[v]));
    const bool continues = std::abs(cosine) > 1 - 1e-9;
    if (v < w) end.owned = false;
    if (continues) continue;
    const double from = walls_[w].distance(walls_[v].from), to = walls_[w].distance(walls_[v].to);
    end.met = static_cast<std::int32_t>(v);
    end.convex = std::max(from, to) > -std::min(from, to);
    end.right = std::abs(cosine) < 1e-4;
  }
  return end;
}

double WallPaths::distance(std::size_t w, const Vec2& place) const {
  const Vec2 line = walls_[w].to - walls_[w].from;
  const double along = std::clamp((place - walls_[w].from).dot(line) / line.squaredNorm(), 0.0, 1.0);
  return (walls_[w].from + along * line - place).norm();
}

bool WallPaths::all_in_sight(std::span<const Vec2> points) const {
  for (const auto& ends : ends_)
    for (const End& end : ends)
      if (end.corner() && !(end.convex && end.right)) return false;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (const Vec2& p : points)
      if (walls_[w].distance(p) < -slack_ && distance(w, p) < range_) return false;
  return true;
}

std::vector<std::int32_t> WallPaths::near(const Vec2& place) const {
  std::vector<std::int32_t> found;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (distance(w, place) < range_) found.push_back(static_cast<std::int32_t>(w));
  return found;
}

/// A point of a wall's line belongs to it between its ends; of walls that meet, one owns the end. At a convex
/// corner, a path that has just turned there meets the other as well. A re-entrant corner is only met by
/// lines that lead behind both walls; others pass.
bool WallPaths::crosses(std::size_t w, const Vec2& at, const Vec2& beyond, const Vec2& turned_at) const {
  const double along = (at - walls_[w].from).dot(direction(walls_[w]));
  const double length = (walls_[w].to - walls_[w].from).norm();
  if (along > slack_ && along < length - slack_) return true;
  if (along < -slack_ || along > length + slack_) return false;
  const End& end = ends_[w][along < 0.5 * length ? 0 : 1];
  if (end.corner() && !end.convex)
    return end.owned && std::max(walls_[w].distance(beyond), walls_[end.met].distance(beyond)) < 0;
  return end.owned || (end.convex && (turned_at - end.at).norm() < 2 * slack_);
}

bool WallPaths::clear(const Vec2& from, const Vec2& to, std::span<const std::int32_t> near) const {
  constexpr double nowhere = never;
  return std::none_of(near.begin(), near.end(), [&](std::int32_t w) {
    const double before = walls_[w].distance(from), after = walls_[w].distance(to);
    if (std::abs(before) <= slack_ || std::abs(after) <= slack_ || (before > 0) == (after > 0)) return false;
    return crosses(w, from + before / (before - after) * (to - from), to, {nowhere, nowhere});
  });
}

bool WallPaths::leads(const Vec2& from, const Vec2& at, std::size_t image, std::span<const Image> images,
                      std::size_t particles, std::span<const std::int32_t> near) const {
  Vec2 start = from, end = at, turned_at(never, never);
  for (;;) {
    const auto w = static_cast<std::size_t>(images[image].wall);
    const double before = walls_[w].distance(start), after = walls_[w].distance(end);
    if (before < -slack_ || after >= 0) return false;
    const Vec2 crossing = start + std::max(before, 0.0) / (std::max(before, 0.0) - after) * (end - start);
    if (!crosses(w, crossing, end, turned_at) || !clear(start, crossing, near)) return false;
    start = turned_at = crossing;
    end = walls_[w].mirrored(end);
    const auto parent = static_cast<std::size_t>(images[image].parent);
    if (parent < particles) return clear(start, end, near);
    image = parent - particles;
  }
}

/// Images of points, of images and so on, as far as paths could reach; appended to `points`.
std::vector<Image> WallPaths::candidates(std::vector<Vec2>& points) const {
  const std::size_t n = points.size();
  std::vector<Image> images;
  std::size_t first = 0;
  for (int turns = 0; turns < most_turns && first < points.size(); ++turns) {
    const std::size_t last = points.size();
    for (std::size_t w = 0; w < walls_.size(); ++w)
      for (std::size_t i = first; i < last; ++i) {
        if (i >= n && images[i - n].wall == static_cast<std::int32_t>(w)) continue;
        if (walls_[w].distance(points[i]) <= slack_ || distance(w, points[i]) >= range_) continue;
        images.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(w)});
        points.push_back(walls_[w].mirrored(points[i]));
      }
    first = last;
  }
  return images;
}

std::vector<Image> WallPaths::append_seen_images(std::vector<Vec2>& points) const {
  const std::size_t n = points.size();
  const std::vector<Image> all = candidates(points);
  const std::span<const Vec2> particles(points.data(), n), places(points.data() + n, all.size());
  const NeighbourList viewers = find_neighbours(places, particles, range_);
  std::vector<std::vector<std::int32_t>> near(n);
  for (const std::int32_t a : viewers.index)
    if (near[a].empty()) near[a] = this->near(points[a]);
  std::vector<std::uint8_t> kept(all.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto of = viewers.of(i);
    kept[i] = std::any_of(of.begin(), of.end(),
                          [&](std::int32_t a) { return leads(points[a], places[i], i, all, n, near[a]); });
  }
  for (std::size_t i = all.size(); i-- > 0;)
    if (kept[i] && all[i].parent >= static_cast<std::int32_t>(n)) kept[all[i].parent - n] = 1;

  std::vector<Image> images;
  std::vector<std::int32_t> number(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!kept[i]) continue;
    number[i] = static_cast<std::int32_t>(n + images.size());
    const std::int32_t parent = all[i].parent;
    points[number[i]] = places[i];
    images.push_back({parent < static_cast<std::int32_t>(n) ? parent : number[parent - n], all[i].wall});
  }
  points.resize(n + images.size());
  return images;
}

}  // namespace porosph
