// Which particles see each other past the outlines of the soil, and which ghosts they see through a wall.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/boundary/ghosts.hpp"
#include "solver/case/case.hpp"
#include "solver/particles/particles.hpp"

namespace porosph {

/// Everything is decided by where particles started, since the outlines are those of t = 0. Two particles of
/// the soil do not see each other where the straight line between them leaves the soil, through a wall, a
/// slit or a gap. They do around a corner that leaves more than 60 degrees free, such as a toe; and past a
/// free surface once they have come nearer than the spacing (contact). A particle sees a ghost where the line
/// to it leaves the soil through the wall, or one of the walls, that the ghost is mirrored in. So the walls
/// of a thin plate, of a hole and of a re-entrant corner each act on their own side.
class Visibility {
 public:
  Visibility() = default;  ///< nothing is hidden
  /// `range`: of the kernel; `spacing` of the particles [m].
  Visibility(const std::vector<SoilCase>& soils, std::span<const Wall> walls, const Particles& particles,
             double range, double spacing);

  /// In most scenes nothing is hidden from anything within the kernel's range.
  bool everywhere() const { return everywhere_; }
  /// No ghost is hidden; soil may be, past slits and gaps.
  bool ghosts_everywhere() const { return ghosts_everywhere_; }

  /// Whether particle a sees particle b.
  bool sees(std::int32_t a, std::int32_t b, const Particles& particles) const;
  /// Whether particle a sees a ghost.
  bool sees_ghost(std::int32_t a, std::size_t ghost, const Ghosts& ghosts, const Particles& particles) const;
  /// Whether a point of the soil at the start sees a particle [m].
  bool sees_from(const Vec2& point, std::int32_t b, const Particles& particles) const;

 private:
  struct Edge {
    Vec2 a, b;
    bool wall;  ///< lies on a wall
  };
  /// Where a line leaves the soil: all edges that meet there, and the one through which it comes back.
  struct Exit {
    std::vector<const Edge*> out;
    const Edge* back = nullptr;
    bool stays() const { return out.empty(); }
  };
  Exit exit(const Vec2& from, const Vec2& to) const;
  bool hides(const Exit& exit) const;
  bool is_image_in_one_wall(const Vec2& start, std::size_t ghost, const Ghosts& ghosts) const;
  bool in_soil(const Vec2& p) const;
  void find_hidden(std::span<const Wall> walls, const Particles& particles);

  std::vector<Edge> edges_;
  std::vector<std::vector<Polygon>> rings_;  ///< of each soil: outline, then holes
  double range_ = 0, spacing_ = 0;
  bool everywhere_ = true, ghosts_everywhere_ = true;
};

}  // namespace porosph
