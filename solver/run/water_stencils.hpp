// What the pore water of soil in motion flows by: the soil as it was drawn, and then as its particles lie.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solver/run/drainage.hpp"
#include "solver/run/pore_permeability.hpp"

namespace porosph {

/// As drawn until renew(); from then on walls mirror the particles as they lie, and no face was drawn.
class WaterStencils {
 public:
  WaterStencils(const Case& scene, const Model& model);

  /// T for a step of 1 s, with tau = gamma_w / rho.
  const PressureStabilisation& inertia() const { return inertia_; }
  bool drains() const { return drainage_.has_value(); }
  bool has_moved() const { return !made_at_.empty(); }
  /// On a face that drains, as drawn.
  bool is_pinned(std::size_t a) const { return drainage_ && drainage_->pinned[a] >= 0; }
  /// H = -dR/dh: only where it drains.
  const SparseRows& slope() const { return slope_; }
  std::span<const double> still_inflow() const { return still_inflow_; }  ///< R(0) [m2/s]
  double through_faces(std::span<const double> head) const;               ///< [m2/s]
  /// What flows out per head through the free surface of soil that has moved, half a cell above its
  /// uppermost particles [m/s].
  double outlet(std::size_t a) const { return free_.outlet.empty() ? 0 : pores_.ratio(a) * free_.outlet[a]; }
  /// In half a cell on that surface, where the excess head is 0.
  bool lies_on_free_surface(std::size_t a) const { return !free_.holds.empty() && free_.holds[a] != 0; }

  void renew(const Particles& particles);
  /// Permeability goes with the pores, by the volume that each particle has gained [m2]; returns whether it
  /// has changed. Throws std::runtime_error where a soil has no pores left.
  bool follow_pores(std::span<const double> gained);
  void visit(StateArchive& state, const Particles& particles);  ///< saves or restores all of it

 private:
  /// Of moved soil, each particle.
  struct FreeSurface {
    std::vector<double> outlet;  ///< [m/s]
    std::vector<std::uint8_t> holds;
  };
  void make(const Particles& as_they_lie);
  void find_free_surface(const Particles& as_they_lie);
  void take_slope(std::size_t particles);

  std::vector<SoilCase> soils_, of_inertia_;  ///< those of the second have gamma_w / rho as permeability
  HydraulicOutline walls_;
  double spacing_;
  std::optional<Drainage> drainage_;  ///< nothing: undrained
  PorePermeability pores_;
  PressureStabilisation inertia_;
  SparseRows slope_;
  std::vector<double> still_inflow_;
  FreeSurface free_;           ///< empty: as drawn, or undrained
  std::vector<Vec2> made_at_;  ///< nothing: as drawn
  std::vector<double> density_then_;
};

}  // namespace porosph
