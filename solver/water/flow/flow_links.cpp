#include "solver/water/flow/flow_links.hpp"

#include <cmath>

#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {

FlowLinks::FlowLinks(const std::vector<SoilCase>& soils, const HydraulicOutline& outline,
                     const Particles& particles, double spacing, bool as_drawn)
    : outline_(outline), p_(particles), spacing_(spacing), as_drawn_(as_drawn), points_(particles.position) {
  const CubicSpline<2> kernel(spacing);
  ghosts_ = Ghosts(outline.stretches, 0, outline.stretches.size(), kernel.support(), points_);
  for (std::size_t a = 0; a < p_.size(); ++a) cell_.push_back(p_.volume(a) / p_.fill[a]);
  ghosts_.fill<Mirrors::scalar>(cell_);
  link(OutlineSight(soils, kernel.support(), spacing), kernel);
}

void FlowLinks::link(const OutlineSight& sight, const CubicSpline<2>& kernel) {
  const NeighbourList all = find_neighbours(points_, particles(), (1 - 1e-9) * kernel.support());
  const auto n = static_cast<std::int32_t>(particles());
  begin_ = {0};
  for (std::int32_t a = 0; a < n; ++a) {
    for (const std::int32_t b : all.of(a)) {
      const bool seen =
          b < n ? first_stretch_between(points_[a], points_[b]) < 0 : sees_ghost(sight, a, b - n);
      const Vec2 x = points_[b] - points_[a];
      const double f = -cell_[b] * kernel.slope(x.norm());
      if (seen && f > 0) links_.push_back({a, b, x, f});
    }
    begin_.push_back(std::ssize(links_));
  }
}

/// The stretch that a line from one point to another meets first, -1 where it stays in the soil. Water
/// does not pass around the outside of a corner. At a periodic stretch the soil continues.
int FlowLinks::first_stretch_between(const Vec2& from, const Vec2& to) const {
  const double slack = on_outline * spacing_;
  int first = -1;
  double nearest = 2;
  for (std::size_t s = 0; s < outline_.stretches.size(); ++s) {
    const Wall& wall = outline_.stretches[s];
    const double before = wall.distance(from), after = wall.distance(to);
    if (wall.is_periodic()) continue;
    if (!(before > slack && after < -slack) && !(before < -slack && after > slack)) continue;
    const double t = before / (before - after);
    const double at = outline_.along(static_cast<int>(s), from + t * (to - from));
    if (at < -slack || at > (wall.to - wall.from).norm() + slack || t >= nearest) continue;
    nearest = t, first = static_cast<int>(s);
  }
  return first;
}

/// Two stretches may lie in one line, with a notch between them: what is beside the one has no image in the
/// other.
bool FlowLinks::is_beside_its_stretch(std::size_t ghost) const {
  if (ghosts_.stems_from_ghost(ghost)) return is_beside_its_stretch(ghosts_.parent(ghost) - particles());
  const int stretch = ghosts_.image(ghost).wall;
  const Wall& wall = outline_.stretches[stretch];
  if (wall.is_periodic()) return true;
  const double at = outline_.along(stretch, points_[ghosts_.parent(ghost)]), slack = on_outline * spacing_;
  return at > -slack && at < (wall.to - wall.from).norm() + slack;
}

/// Images of images lie in corners, where the line to them may pass either stretch.
bool FlowLinks::sees_ghost(const OutlineSight& sight, std::int32_t a, std::size_t ghost) const {
  if (!is_beside_its_stretch(ghost)) return false;
  if (lies_on_mirror(a, ghost)) return true;
  if (ghosts_.stems_from_ghost(ghost)) return !as_drawn_ || sight.sees_ghost(a, ghost, ghosts_, p_);
  const int stretch = ghosts_.wall(ghost).is_periodic() ? -1 : ghosts_.image(ghost).wall;
  return first_stretch_between(points_[a], points_[particles() + ghost]) == stretch;
}

/// From a particle on the outline, all that is mirrored in that stretch is in sight.
bool FlowLinks::lies_on_mirror(std::int32_t a, std::size_t ghost) const {
  const Wall& last = ghosts_.wall(ghost);
  const bool on_last = std::abs(last.distance(points_[a])) < on_outline * spacing_;
  return on_last ||
         (ghosts_.stems_from_ghost(ghost) && lies_on_mirror(a, ghosts_.parent(ghost) - particles()));
}

}  // namespace porosph
