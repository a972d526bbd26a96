// How well water passes between particles.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/water/flow/flow_links.hpp"

namespace porosph {

/// c_ab of pair_flux.hpp: M of each particle, and mu.
class Conductances {
 public:
  /// Of links that must outlive it. `closed`: with mu, and with M corrected for what the mean of two
  /// particles and mu change in disorder.
  Conductances(const std::vector<SoilCase>& soils, const Particles& particles, const FlowLinks& links,
               double spacing, bool closed);

  double of(const FlowLink& l) const;          ///< saturated [m/s]
  Vec2 permeability(const FlowLink& l) const;  ///< harmonic mean of both soils [m/s]
  static double mean(const Vec2& k) { return std::sqrt(k.x() * k.y()); }

 private:
  /// M for permeability 1 along x alone, and along y alone.
  struct Moments {
    Mat2 of_x, of_y;
    Mat2 of(const Vec2& k) const { return k.x() * of_x + k.y() * of_y; }
  };
  void make_moments();
  void correct_moments();
  Mat2 second_moment(std::size_t a) const;
  double weight(const FlowLink& l, const Vec2& k) const;
  double closing(const FlowLink& l) const;
  std::vector<Vec2> imbalance() const;
  void change(const std::vector<Vec2>& mu, std::vector<Vec2>& out) const;
  bool close();

  const std::vector<SoilCase>& soils_;
  const Particles& p_;
  const FlowLinks& links_;
  double spacing_;
  bool closed_;
  std::vector<Moments> moments_;
  std::vector<std::uint8_t> held_;  ///< 1 where the links span the plane
  std::vector<Vec2> mu_;
};

}  // namespace porosph
