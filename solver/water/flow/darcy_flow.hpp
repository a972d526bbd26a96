// Darcy's law between particles: what flows into each of them for a head, and how that changes with the head.
#pragma once

#include <span>
#include <vector>

#include "solver/water/flow/face_conditions.hpp"
#include "solver/water/flow/pair_flux.hpp"
#include "solver/water/flow/retention.hpp"
#include "solver/water/flow/sparse_rows.hpp"

namespace porosph {

/// Into particle a flows [m2/s per metre of thickness]
///
///   R_a = sum_b c_ab (kr_a + kr_b)/2 (h_b - h_a) + sum_faces c_ab (2 h_face - h_b - h_a) + rates,
///
/// where psi = h - y gives kr of each. A sum over all particles leaves what passes the faces alone.
class DarcyFlow {
 public:
  /// `soil` of each particle; `height`: their y [m].
  DarcyFlow(FlowPairs pairs, const HydraulicOutline& outline, std::vector<Retention> retention,
            std::span<const std::int32_t> soil, std::span<const double> height);

  std::size_t particles() const { return height_.size(); }
  const FlowPairs& pairs() const { return pairs_; }
  double height(std::size_t a) const { return height_[a]; }
  const Retention& retention(std::size_t a) const { return retention_[soil_[a]]; }

  enum class Slope {
    secant,  ///< kr as it is: symmetric, positive definite
    newton   ///< with dkr/dpsi: not symmetric
  };
  /// Fills `inflow` with R, and `slope` with -dR/dh. Particles that lie on a face with a head keep theirs:
  /// their rows are those of the identity, their inflow 0.
  void assemble(std::span<const double> head, const FaceConditions& faces, Slope kind, SparseRows& slope,
                std::span<double> inflow) const;

  /// Puts particles that lie on a face with a head at that head.
  void pin(std::span<double> head, const FaceConditions& faces) const;

  /// Into the soil through each patch [m2/s].
  std::vector<double> through_patches(std::span<const double> head, const FaceConditions& faces) const;
  /// Pressure head at each patch, as if nothing passed it [m]; -infinity where no particle is near.
  std::vector<double> pressure_heads_at_patches(std::span<const double> head) const;

  /// Darcy velocity w = -K kr grad h of the particles, from what passes between pairs [m/s]; with `saturated`
  /// as if kr were 1.
  std::vector<Vec2> velocities(std::span<const double> head, const FaceConditions& faces,
                               std::span<const Vec2> position, bool saturated = false) const;

  /// A particle of a part of the soil that no face with a head can reach; -1 where there is none.
  std::int32_t unreached(const FaceConditions& faces) const;

 private:
  struct Image {
    double sign, constant;  ///< h of the image = sign * h of the particle + constant
    bool fixed;             ///< a head is given at the face
    std::int32_t patch;     ///< that has it
  };
  Image image(const FacePair& pair, const FaceConditions& faces) const;
  void make_pattern();
  template <class Use>
  void for_flows(std::size_t a, std::span<const double> head, std::span<const double> kr,
                 const FaceConditions& faces, Use&& use) const;
  std::vector<std::int32_t> pinning_patches(const FaceConditions& faces) const;
  double drawn_from(std::size_t a, std::span<const double> head, std::span<const double> kr) const;
  std::vector<double> permeabilities(std::span<const double> head) const;

  FlowPairs pairs_;
  std::vector<Retention> retention_;
  std::vector<std::int32_t> soil_;
  std::vector<double> height_;
  std::vector<double> patch_length_;
  std::vector<std::int32_t> fed_by_patch_;  ///< particle that takes a patch's rate, or -1
  SparseRows pattern_;
  std::vector<std::int32_t> slot_, face_slot_;  ///< of each pair in the pattern; -1: the diagonal
};

}  // namespace porosph
