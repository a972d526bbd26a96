// Walls as the end of the way, where soil flows and its stress alone might let particles through.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/particles/state.hpp"

namespace porosph {

/// Changes accelerations so that the particles that are watched come no nearer to walls than they may. A wall
/// takes all of the velocity towards it, without rebound, and along it as much as it bears: the friction and
/// cohesion of the particle's soil at fixed walls, the coefficient of walls with friction, nothing at
/// rollers.
class WallStop {
 public:
  void clear() { watched_.clear(); }
  void watch(std::int32_t particle, double nearest) { watched_.push_back({particle, nearest}); }  ///< [m]

  /// Of the step that begins; may be called again for the same one. Does nothing before the first [m/s2].
  void apply(const Model& model, std::span<Vec2> accelerations);
  void stepped(double dt);               ///< ends it; the next one is as long [s]
  double work() const { return work_; }  ///< that walls have so taken [J/m]
  void visit(StateArchive& state);

 private:
  struct Watched {
    std::int32_t particle;
    double nearest;
  };
  Vec2 velocity_after(const Model& model, const Watched& watched, Vec2 velocity) const;

  std::vector<Watched> watched_;
  double step_ = 0, work_ = 0, taken_next_ = 0;
};

}  // namespace porosph
