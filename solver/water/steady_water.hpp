// Pore water in steady flow, which the soil comes to rest in.
#pragma once

#include <limits>

#include "solver/water/flow/flow_record.hpp"
#include "solver/water/flow/steady_seepage.hpp"
#include "solver/water/pore_water.hpp"

namespace porosph {

/// The flow is computed once, in the soil as it is drawn. Each particle keeps its head; its pore pressure is
/// that of its pressure head where it is now, and the gradient of all pore pressures is buoyancy and seepage
/// force in one.
class SteadyWater final : public PoreWater {
 public:
  /// Throws std::runtime_error as solve_steady() does, and where a part of the soil has no face with a head.
  SteadyWater(const Case& scene, const Particles& particles);

  /// Gives the particles their pore pressure, and the weight of saturated soil below the water table.
  void wet(const Case& scene, Particles& particles) const;

  bool acts(const StandingWater&) const override { return true; }
  double stable_step() const override { return std::numeric_limits<double>::infinity(); }
  void follow(const StandingWater& standing, Particles& particles, std::size_t first,
              std::size_t last) const override;
  void flow(const StandingWater&, Particles&, double) override {}
  /// Behind walls the head continues linearly.
  void fill_ghosts(const StandingWater& standing, const Particles& particles, const Ghosts& ghosts,
                   std::span<const Vec2> places, std::span<double> pressure) const override;
  void visit(StateArchive&) override {}
  const FlowRecord* record() const override { return &record_; }

 private:
  double unit_weight_;  ///< of water [N/m3]
  DarcyFlow flow_;
  FlowRecord record_;
};

}  // namespace porosph
