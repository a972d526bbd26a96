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
/// where psi = h - y gives kr of each; kr of the one that water comes from takes the place of the mean where
/// that is asked for. Where soil has deformed, kr counts times what that has made of its k. Faces are wet,
/// but those that have dried up have the mean of their kr and the soil's. A sum over all particles leaves
/// what passes the faces alone.
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

  /// The patch whose head a particle on the outline has; -1 for all others.
  std::vector<std::int32_t> pinning_patches(const FaceConditions& faces) const;
  enum class Mean {
    arithmetic,  ///< of second order
    upstream     ///< of first order, never out of bounds
  };
  void set_mean(Mean mean) { mean_ = mean; }
  /// k of each particle over that of its soil; none: 1.
  void set_permeability_ratio(std::span<const double> ratio) { ratio_.assign(ratio.begin(), ratio.end()); }

  /// Puts particles that lie on a face with a head at that head.
  void pin(std::span<double> head, const FaceConditions& faces) const;

  /// Into the soil through each patch [m2/s].
  std::vector<double> through_patches(std::span<const double> head, const FaceConditions& faces) const;
  /// Pressure head at each patch, as if nothing passed it [m]; -infinity where no particle is near.
  std::vector<double> pressure_heads_at_patches(std::span<const double> head) const;
  /// What would enter through each patch if it were held at its limit of a state [m2/s]; particles that lie
  /// on it left out.
  std::vector<double> through_patches_if(std::span<const double> head, const FaceConditions& faces,
                                         PatchState state) const;
  /// The particle on the outline that stands for a patch, or -1.
  std::int32_t holder(std::int32_t patch) const { return holder_[patch]; }
  std::int32_t fed_by(std::int32_t patch) const { return fed_by_patch_[patch]; }  ///< takes its rate, or -1
  double patch_length(std::int32_t patch) const { return patch_length_[patch]; }  ///< [m]
  /// Whether the face that a pair passes has a head now, so that it is not a pair of particles.
  bool has_head(const FacePair& pair, const FaceConditions& faces) const { return image(pair, faces).fixed; }
  /// From particle b to a [m2/s], of conductance c.
  double between(std::int32_t a, std::int32_t b, double c, std::span<const double> head) const;

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
    double dry_kr = -1;     ///< kr of a face that has dried up, or negative
  };
  Image image(const FacePair& pair, const FaceConditions& faces) const;
  void find_holders();
  /// Share of a in kr of the pair that water flows through, for h_b - h_a.
  double share_of_first(double fall) const { return mean_ == Mean::arithmetic ? 0.5 : fall < 0 ? 1 : 0; }
  double ratio(std::size_t a) const { return ratio_.empty() ? 1 : ratio_[a]; }
  /// kr at a head, with the ratio.
  Retention::Permeability permeability(std::size_t a, double head) const;
  double through_kr(const Image& image, std::size_t a, double kr) const {
    return image.dry_kr < 0 ? ratio(a) : (kr + ratio(a) * image.dry_kr) / 2;
  }
  void make_pattern();
  template <class Use>
  void for_flows(std::size_t a, std::span<const double> head, std::span<const double> kr,
                 const FaceConditions& faces, Use&& use) const;
  double drawn_from(std::size_t a, std::span<const double> head, std::span<const double> kr) const;
  std::vector<double> permeabilities(std::span<const double> head) const;

  FlowPairs pairs_;
  std::vector<Retention> retention_;
  std::vector<std::int32_t> soil_;
  std::vector<double> height_;
  std::vector<double> patch_length_;
  std::vector<std::int32_t> fed_by_patch_;  ///< particle that takes a patch's rate, or -1
  std::vector<std::int32_t> holder_;
  Mean mean_ = Mean::arithmetic;
  std::vector<double> ratio_;
  SparseRows pattern_;
  std::vector<std::int32_t> slot_, face_slot_;  ///< of each pair in the pattern; -1: the diagonal
};

}  // namespace porosph
