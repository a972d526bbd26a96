// Pore water that flows: each particle has a head, which its pore pressure follows from.
#pragma once

#include <limits>
#include <string>

#include "solver/space/place_text.hpp"
#include "solver/water/flow/darcy_flow.hpp"
#include "solver/water/flow/flow_record.hpp"
#include "solver/water/flow/section_flow.hpp"
#include "solver/water/pore_water.hpp"

namespace porosph {

/// Each particle keeps its head while the soil moves; its pore pressure is that of its pressure head where it
/// is now, and the gradient of all pore pressures is buoyancy and seepage force in one. Soil that slides
/// takes its water along: each particle then keeps its pressure head instead.
class FlowingWater : public PoreWater {
 public:
  /// Of the particles as they are drawn. `origin`: what their positions are relative to, for messages. Throws
  /// std::runtime_error where a drain is near none.
  FlowingWater(const Case& scene, const Particles& particles, const Vec2& origin);

  /// Gives the particles their pore pressure, and their weight: between that of dry and of saturated soil by
  /// the share of the particle below the water table; over time by saturation, where there is a retention
  /// curve.
  void wet(const Case& scene, Particles& particles) const;
  /// Unit weight of a particle's soil as it is wet now [N/m3].
  double unit_weight(const SoilCase& soil, std::size_t a, double area, const Vec2& place) const;

  bool acts(const StandingWater&) const override { return true; }
  double stable_step() const override { return std::numeric_limits<double>::infinity(); }
  void follow(const StandingWater& standing, Particles& particles, std::size_t first,
              std::size_t last) const override;
  void flow(const StandingWater&, Particles&, double) override {}
  /// Behind walls the head continues linearly.
  void fill_ghosts(const StandingWater& standing, const Particles& particles, const Ghosts& ghosts,
                   std::span<const Vec2> places, std::span<double> pressure) const override;
  const FlowRecord* record() const override { return &record_; }

 protected:
  void take_along(const Particles& particles);
  void visit_taken_along(StateArchive& state);
  bool is_taken_along() const { return !taken_along_.empty(); }
  double pressure_head(std::size_t a, const Vec2& place) const {
    return is_taken_along() ? taken_along_[a] : record_.head[a] - place.y();
  }

  /// Tells of the flow that heads and faces make, as of the particles' places at the start.
  void tell(std::vector<double> head, const FaceConditions& faces);
  std::vector<double> through_sections(std::span<const double> head, const FaceConditions& faces) const;
  /// The number of each patch's face or drain, as below; -1: one that the case does not name.
  std::vector<int> face_of_patch() const;
  /// Where a particle was drawn, in the case's coordinates.
  std::string place(std::size_t a) const { return place_text(place_[a] + origin_); }
  std::size_t named_faces() const { return faces_.size() - first_named_; }
  /// Into the soil through each of the case's faces, then through its drains [m2/s].
  std::vector<double> through_faces(std::span<const double> head, const FaceConditions& faces) const;

  std::vector<HydraulicFaceCase> faces_;  ///< usual ones, of the case, then of its drains
  std::size_t first_named_;
  HydraulicOutline outline_;
  DarcyFlow flow_;
  FlowRecord record_;

 private:
  DarcyFlow make_flow(const Case& scene, const Particles& particles, const Vec2& origin);

  Vec2 origin_;                             ///< of positions [m]
  double unit_weight_;                      ///< of water [N/m3]
  bool weighs_by_saturation_;               ///< above the water table, where the soil has a retention curve
  std::vector<Vec2> place_, permeability_;  ///< of the particles: where they were drawn [m], k [m/s]
  std::vector<SectionFlow> sections_;
  std::vector<double> taken_along_;  ///< psi of the particles; empty: they keep their heads [m]
};

}  // namespace porosph
