// Which particles see each other past the outlines of the soil, and which ghosts they see through a wall.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/boundary/soil_outlines.hpp"
#include "solver/boundary/wall_paths.hpp"
#include "solver/case/case.hpp"
#include "solver/particles/particles.hpp"

namespace porosph {

/// Walls stand where they are, so lines between particles are held against them where the particles are now.
/// Free edges of the outlines move with the soil, so they count where the particles started: two particles do
/// not see each other where the straight line between their starts leaves the soil, through a slit or a gap.
/// They do around a corner that leaves more than 60 degrees free, such as a toe; and once they have come
/// nearer than the spacing (contact). Never do they see each other through a sheet, which lies between those
/// that started on its two sides. What is seen behind walls is the matter of WallPaths.
class Visibility {
 public:
  Visibility() = default;  ///< nothing is hidden
  /// `range`: of the kernel; `spacing` of the particles [m].
  Visibility(const std::vector<SoilCase>& soils, std::span<const Wall> walls, const Particles& particles,
             double range, double spacing, const std::vector<SheetCase>& sheets = {});

  /// In most scenes nothing is hidden from anything within the kernel's range.
  bool everywhere() const { return ghosts_everywhere_ && !has_slits_ && sheets_.empty(); }
  /// No ghost is hidden, and mirroring in one wall after the other makes all; soil may be, past slits and
  /// gaps.
  bool ghosts_everywhere() const { return ghosts_everywhere_; }

  /// As it is without sheets.
  Visibility without_sheets() const;

  /// Whether particle a sees particle b.
  bool sees(std::int32_t a, std::int32_t b, const Particles& particles) const;
  /// No slit, gap or sheet parts them.
  bool past_slits(std::int32_t a, std::int32_t b, const Particles& particles) const;
  const WallPaths& walls() const { return walls_; }
  /// Whether a point of the soil at the start sees a particle [m].
  bool sees_from(const Vec2& point, std::int32_t b, const Particles& particles) const;

 private:
  bool through_sheet(const Vec2& from, const Vec2& to) const;
  bool through_slit(const Vec2& from, const Vec2& to) const;
  bool any_slit_hides(const Particles& particles);

  SoilOutlines outlines_;
  std::vector<std::uint8_t> near_edge_;  ///< of particles: within the range of an edge at the start
  WallPaths walls_;
  std::vector<Wall> segments_;  ///< walls, as far as outlines go
  std::vector<SoilOutlines::Edge> sheets_;
  double range_ = 0, spacing_ = 0;
  bool has_slits_ = false, ghosts_everywhere_ = true;
};

}  // namespace porosph
