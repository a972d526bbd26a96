// Pore water at rest: as high as the water that stands above the soil.
#pragma once

#include <limits>

#include "solver/water/pore_water.hpp"

namespace porosph {

/// Hydrostatic pore pressure (eq. 12), whatever the soil does.
class StillWater final : public PoreWater {
 public:
  bool acts(const StandingWater& standing) const override { return standing.present(); }
  double stable_step() const override { return std::numeric_limits<double>::infinity(); }
  void follow(const StandingWater& standing, Particles& particles, std::size_t first,
              std::size_t last) const override;
  void flow(const StandingWater&, Particles&, double) override {}
  /// At the ghost's height, below the level in front of the wall (a stretch may end there).
  void fill_ghosts(const StandingWater& standing, const Particles& particles, const Ghosts& ghosts,
                   std::span<const Vec2> places, std::span<double> pressure) const override;
  void visit(StateArchive&) override {}
};

}  // namespace porosph
