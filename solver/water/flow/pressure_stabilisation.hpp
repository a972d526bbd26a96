// What keeps pore pressure from alternating between particles where no water can flow.
#pragma once

#include <span>
#include <vector>

#include "solver/water/flow/darcy_flow.hpp"

namespace porosph {

/// Pressure and volume live on the same particles, so a pressure that alternates from one to the next strains
/// nothing, and soil without drainage shows it (inf-sup condition; Bochev, Dohrmann, Gunzburger 2006). To the
/// water content of each particle this adds
///
///   T h = - tau (L_compact - L_wide) h,      tau = a gamma_w dx^2 / M
///
/// with two Laplacians of the excess head h that differ in what alternates only: flow from pair to pair, and
/// the divergence of a particle's mean flow,
///
///   h.L_compact h = -1/2 sum_ab c_ab (h_b - h_a)^2,
///   h.L_wide h    = -1/2 sum_a q_a.A_a^-1 q_a,   q_a = sum_b c_ab (h_b - h_a) x_ab,  A_a = sum_b c_ab x (x)
///   x
///
/// so T is symmetric, not negative (Cauchy and Schwarz), and 0 for linear heads. Both see mirror images
/// behind the whole outline. Its sum over the particles is 0: no water comes or goes.
class PressureStabilisation {
 public:
  PressureStabilisation() = default;  ///< none
  /// c_ab of `closed` [m]: permeability tau in each soil. `position` of the particles.
  PressureStabilisation(const DarcyFlow& closed, const HydraulicOutline& outline,
                        std::span<const Vec2> position);

  bool active() const { return !second_.empty(); }
  /// -tau L_compact, an upper bound of T.
  const SparseRows& compact() const { return compact_; }
  /// T h of each particle [m2].
  void apply(std::span<const double> head, std::span<double> out) const;

 private:
  /// Of each particle in turn.
  struct Links {
    std::vector<std::int64_t> begin;
    std::vector<std::int32_t> to;  ///< b
    std::vector<Vec2> flow;        ///< c_ab x_ab [m2]

    /// Calls use(b, c_ab x_ab) for those of a.
    template <class Use>
    void of(std::size_t a, Use&& use) const {
      for (auto k = begin[a]; k < begin[a + 1]; ++k) use(to[k], flow[k]);
    }
  };

  Links pairs_, images_;      ///< with particles; with images, as the particles that they mirror
  std::vector<Mat2> second_;  ///< A^-1 / 2 of the particles
  SparseRows compact_;
};

}  // namespace porosph
