// The Laplacian of the pore water's flow on the soil's particles: one conductance for each pair.
#pragma once

#include <vector>

#include "solver/case/case.hpp"
#include "solver/particles/particles.hpp"
#include "solver/water/flow/outline.hpp"

namespace porosph {

/// Between particles a and b the flow c_ab (h_b - h_a) [m2/s per metre of thickness] passes into a and out of
/// b, so water is conserved to rounding. With K the permeability,
///
///   c_ab = V_a V_b F_ab [ x.(M_a + M_b) x / |x|^2 + k (mu_b - mu_a).x ],   F_ab = -(dW/dr) / r,
///
/// where M is such that sum_b V_b F_ab (x.M x / |x|^2) x (x) x = K, which makes the discharge of a uniform
/// flow exact for each particle, and mu such that sum_b c_ab x_ab = 0, which makes a linear head the exact
/// solution (the scalar sister of closed_gradients.hpp). K of a pair is the harmonic mean of both soils, for
/// flow across layers. Behind the whole outline there are mirror images of the particles: even ones of the
/// head where nothing passes, odd ones about the head that a face has.
struct FlowPair {
  std::int32_t to;     ///< b, a particle
  double conductance;  ///< c_ab, saturated [m/s]
};

/// A pair of a particle and an image.
struct FacePair {
  std::int32_t from, to;                      ///< a, and the particle b that is mirrored
  double conductance;                         ///< [m/s]
  Vec2 x;                                     ///< from a to the image [m]
  int images = 1;                             ///< 2: an image of an image, in a corner
  std::array<std::int32_t, 2> patch{-1, -1};  ///< where the line to the image passes the outline
  std::array<double, 2> crossing{};           ///< y there [m]
  std::array<double, 2> foot{};               ///< y on the outline beside what is mirrored [m]
};

struct FlowPairs {
  std::vector<std::int64_t> begin;  ///< of each particle's pairs
  std::vector<FlowPair> pairs;
  std::vector<FacePair> face_pairs;      ///< by `from`
  std::vector<std::int64_t> face_begin;  ///< of each particle's face pairs
  std::vector<double> volume;            ///< of the particles [m2]
  std::vector<Mat2> correction;          ///< of the velocities that their pairs give
  /// Smaller eigenvalue of sum_b V_b F_ab x (x) x of the particles: 1 inside, 1/2 on a free surface.
  std::vector<double> enclosed;
  /// Particles that lie on the outline, and the patch that they lie on.
  std::vector<std::int32_t> on_face, patch_of_on_face;

  std::vector<std::int32_t> beside_patch;  ///< the particle nearest to each patch

  std::size_t particles() const { return volume.size(); }
  double conductance(std::int32_t a, std::int32_t b) const;  ///< c_ab of a pair, 0 where they are none [m/s]
};

/// Of the particles where they are at the start, with the case's outlines moved to the model's origin.
FlowPairs make_flow_pairs(const std::vector<SoilCase>& soils, const HydraulicOutline& outline,
                          const Particles& particles, double spacing);

/// Of soil that has moved away from its outline as drawn: `walls` mirror it, and its free surface lets
/// nothing pass. Without mu, whose equations need images all around.
FlowPairs make_flow_pairs_of_moved(const std::vector<SoilCase>& soils, const HydraulicOutline& walls,
                                   const Particles& particles, double spacing);

}  // namespace porosph
