// Pore water that flows over time in soil that is saturated in part.
#pragma once

#include "solver/water/flow/richards.hpp"
#include "solver/water/flowing_water.hpp"

namespace porosph {

/// The flow is computed in the soil as it is drawn, which stores water in its pores alone; how the soil moves
/// does not change the flow.
class TransientWater final : public FlowingWater {
 public:
  /// From steady flow at t = 0, from water at rest under a level, or from a pressure head, as the case says.
  /// Throws as SteadyWater.
  TransientWater(const Case& scene, const Particles& particles, const Vec2& origin = Vec2::Zero());

  /// One step of the flow from `now`, not beyond `until` [s]; returns the time that it reached. Pore
  /// pressures, record and weight change with tell() only. Throws std::runtime_error with the place where the
  /// flow does not converge.
  double advance(double now, double until);
  /// Puts the particles' water where the flow is now.
  void tell();
  /// The weight that particles have gained since the start, over that at the start, times g: into the
  /// accelerations [m/s2].
  void add_weight(const Particles& particles, const Vec2& gravity, std::span<Vec2> accelerations) const;

  /// The soil has begun to slide and takes its water along, as it is where the flow is now.
  void stop(const Particles& particles) { take_along(particles); }

  const Richards& richards() const { return richards_; }
  /// Through each section of the case, from its left to its right, where the flow is now [m2/s].
  std::vector<double> through_sections() const {
    return FlowingWater::through_sections(richards_.head(), richards_.faces());
  }
  void visit(StateArchive& state) override;

 private:
  Richards::Start start(const Case& scene, const Particles& particles) const;
  Richards::Settings settings(const Case& scene) const;

  std::vector<SoilCase> soils_;
  std::vector<double> start_density_;  ///< [kg/m3]
  double gravity_;
  Richards richards_;
};

}  // namespace porosph
