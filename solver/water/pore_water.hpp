// What every kind of pore water offers to the integrator.
#pragma once

#include <memory>
#include <span>

#include "solver/boundary/ghosts.hpp"
#include "solver/particles/particles.hpp"
#include "solver/particles/state.hpp"
#include "solver/water/flow/flow_record.hpp"
#include "solver/water/standing_water.hpp"

namespace porosph {

/// The process that gives the particles their pore pressure p_w, beside the motion of the soil. `standing` is
/// the water outside the soil at the end of the step.
class PoreWater {
 public:
  virtual ~PoreWater() = default;

  /// False where no particle's pore pressure ever changes.
  virtual bool acts(const StandingWater& standing) const = 0;

  /// The largest step that the water can be computed with [s]; infinite where it sets none.
  virtual double stable_step() const = 0;

  /// p_w of the particles first to last - 1, which have just moved. Threads call it at once, each for its own
  /// particles.
  virtual void follow(const StandingWater& standing, Particles& particles, std::size_t first,
                      std::size_t last) const = 0;

  /// Lets the water flow over a step dt [s] which has strained the soil.
  virtual void flow(const StandingWater& standing, Particles& particles, double dt) = 0;

  /// p_w at the ghosts, which stand at `places` now. `pressure` is of particles, then ghosts [Pa].
  virtual void fill_ghosts(const StandingWater& standing, const Particles& particles, const Ghosts& ghosts,
                           std::span<const Vec2> places, std::span<double> pressure) const = 0;

  /// How the water flows; nothing where it stands.
  virtual const FlowRecord* record() const { return nullptr; }

  /// Saves or restores what is kept from step to step, particles apart. Throws StateError.
  virtual void visit(StateArchive& state) = 0;
};

}  // namespace porosph
