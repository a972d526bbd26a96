// What holds the outer rows of stiff soil at an interface with soft soil.
#pragma once

#include <span>
#include <vector>

#include "solver/particles/state.hpp"
#include "solver/sph/consistent/reference.hpp"

namespace porosph {

/// The strain across an interface is that of the soft soil, divided by the contrast, in the rows of stiff
/// soil whose kernel reaches the soft one. So hardly any stress tells that such a row moves against the stiff
/// soil behind it. Each of its particles is held there by a spring with the modulus M of its own soil,
///
///   r_a = u_a - sum_b c_ab u_b,    b of a's soil,    energy 1/2 V_a s M / (dx^2 (1 + sum_b c_ab^2)) r_a^2,
///
/// u since the reference, c_ab the weights by which the linear fit of the neighbours' displacements gives
/// that at a: displacements that are linear in the stiff soil, turns among them, stretch nothing. Forces are
/// the gradient of the energy, so that momentum and spin are kept. This is for soils that do not yield, and
/// that are stiffer than another one in reach by as much as AlongInterfaces asks for.
class InterfaceHold {
 public:
  InterfaceHold() = default;
  /// Of the particles in the reference's OwnSides.
  InterfaceHold(const ReferenceConfiguration& reference, const Model& model);

  bool acts() const { return !held_.empty(); }
  void add_forces(const ReferenceConfiguration& reference, const Particles& particles,
                  std::span<Vec2> accelerations);  ///< [m/s2]

 private:
  struct Share {
    std::int32_t of;  ///< in shares_: a particle or ghost; in pulls_: place in held_
    double weight;    ///< c; -1 of the particle that is held
  };
  struct Held {
    std::int32_t particle;
    double stiffness;   ///< [N/m per metre]
    std::size_t first;  ///< in shares_, up to that of the next
  };
  /// All that acts on one particle.
  struct Pulled {
    std::int32_t particle;
    std::size_t first;  ///< in pulls_, up to that of the next
  };
  /// What a ghost's share does to the particle that the ghost stems from.
  struct Mirrored {
    std::int32_t particle, held;
    Mat2 weight;
  };
  void hold(const ReferenceConfiguration& reference, const Model& model, std::int32_t particle);
  void find_pulls(const ReferenceConfiguration& reference);

  std::vector<Held> held_;  ///< and one past the last
  std::vector<Share> shares_;
  std::vector<Vec2> force_;     ///< of each in held_ [N/m]
  std::vector<Pulled> pulled_;  ///< and one past the last
  std::vector<Share> pulls_;
  std::vector<Mirrored> mirrored_;
};

}  // namespace porosph
