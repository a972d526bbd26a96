// Which particles exchange water with each other and with images behind the outline.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/boundary/ghosts.hpp"
#include "solver/case/case.hpp"
#include "solver/particles/particles.hpp"

namespace porosph {

/// All at the start, and with images of images at most, as far as one line goes: simpler than WallPaths,
/// which the soil has, since the whole outline is mirrored here. Two particles do not see each other where
/// the straight line between them leaves the soil through a slit or a gap. They do around a corner that
/// leaves more than 60 degrees free, such as a toe. A particle sees an image where the line to it leaves the
/// soil through the stretch, or one of the stretches, that it is mirrored in.
class OutlineSight {
 public:
  /// `range`: of the kernel; `spacing` of the particles [m].
  OutlineSight(const std::vector<SoilCase>& soils, std::span<const Wall> walls, const Particles& particles,
               double range, double spacing);

  /// Whether particle a sees particle b.
  bool sees(std::int32_t a, std::int32_t b, const Particles& particles) const;
  /// Whether particle a sees a ghost.
  bool sees_ghost(std::int32_t a, std::size_t ghost, const Ghosts& ghosts, const Particles& particles) const;

 private:
  struct Edge {
    Vec2 a, b;
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
  bool everywhere_ = true;
};

}  // namespace porosph
