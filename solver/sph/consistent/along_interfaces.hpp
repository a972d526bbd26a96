// Derivatives along an interface, summed over a particle's own soil alone.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/sph/consistent/reference.hpp"

namespace porosph {

/// Ratio of moduli from which soils are summed apart along their interface: docs/theory.md has what it
/// changes.
constexpr double much_stiffer = 30;

/// The bend c of a displacement where soils meet varies along the interface. A sum over both sides takes this
/// for a strain along it, of the order of dx times the gradient of the strain; in the stiffer soil that is
/// the contrast times what there is. So the derivative along the interface, with its tangent t, is summed
/// over the neighbours of the own soil,
///
///   (grad f)_a . t = sum_b V_b (f_b - f_a) F_ab (q_a . X_ab + (kappa_b - kappa_a) . t),    b of a's soil,
///
/// q_a such that linear fields keep their gradients; kappa where gradients are closed. The derivative across
/// the interface is summed over both sides as elsewhere. What this changes of the gradient is
/// sum_b e_ab (f_b - f_a) (x) t, with a number e_ab for each pair; its adjoint gives the forces. A sum over
/// half of the neighbours has an error of its own, so this is for soils whose stiffness differs by 30 times
/// and more.
class AlongInterfaces {
 public:
  AlongInterfaces() = default;
  /// Of the particles in the reference's OwnSides.
  AlongInterfaces(const ReferenceConfiguration& reference, const Model& model);

  bool acts() const { return !pairs_.empty(); }

  /// What changes of the velocity gradients, from velocities of the particles and ghosts [m/s].
  void take_velocities(const std::array<std::vector<double>, 2>& velocity);
  void connect(OwnSideView& view) const;
  /// sum_b e_ab (v_b - v_a) of the particle at this place in OwnSides [1/s].
  Vec2 change(std::size_t place) const { return {change_[0][place], change_[1][place]}; }

  /// Adds what changes of the accelerations [m/s2] under `piola`, P of particles and ghosts.
  void add_forces(const ReferenceConfiguration& reference, const PlaneTensors& piola,
                  std::span<const double> fill, std::span<Vec2> accelerations);

 private:
  struct Share {
    std::int32_t of;  ///< in change_: the neighbour, particle or ghost; in pulls_: place in sources_
    double weight;    ///< e [1/m]
  };
  /// A particle at an interface, or a ghost that stems from one.
  struct Source {
    std::int32_t point, root;
    Vec2 along;  ///< t
  };
  /// All that acts on one particle.
  struct Pulled {
    std::int32_t particle;
    std::size_t first;  ///< in pulls_, up to that of the next
  };
  class Builder;

  std::vector<std::size_t> first_;  ///< of each place in OwnSides, and one past the last
  std::vector<Share> pairs_;
  std::vector<std::int32_t> particle_;         ///< of each place
  std::array<std::vector<double>, 2> change_;  ///< of each place [1/s]
  std::vector<Source> sources_;
  std::vector<Vec2> traction_;  ///< fill P t of each source [Pa]
  std::vector<Pulled> pulled_;  ///< and one past the last
  std::vector<Share> pulls_;
};

}  // namespace porosph
