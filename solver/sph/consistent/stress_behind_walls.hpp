// The stress behind walls that bear weight, which continues linearly from the soil in front of them.
#pragma once

#include <span>
#include <vector>

#include "solver/sph/consistent/loose_particles.hpp"
#include "solver/sph/consistent/reference.hpp"

namespace porosph {

/// Extrapolates the first Piola-Kirchhoff stress P from particles next to bearing walls, with gradients that
/// see only the soil and its mirror images at other walls. A roller carries no shear.
class StressBehindWalls {
 public:
  StressBehindWalls() = default;
  /// `flows`: the soil may spread to rows too thin for a gradient across them. `loose`, if given: particles
  /// that bear no stress and have no part in gradients.
  StressBehindWalls(const ReferenceConfiguration& reference, bool flows, const LooseParticles* loose);

  /// Fills P of the ghosts: mirrored, or extrapolated where the wall bears weight. `piola`: particles, then
  /// ghosts; of the particles, those that uses() names are read.
  void fill(const ReferenceConfiguration& reference, PlaneTensors& piola);

  /// Marks the particles whose P is asked for.
  void mark_used(const ReferenceConfiguration& reference, std::vector<std::uint8_t>& used) const;

 private:
  struct OneSided {
    std::int32_t particle;
    std::vector<std::int32_t> neighbours;
    std::vector<Vec2> gradient;  ///< exact for linear fields without the extrapolated ghosts
    double determinant = 1;      ///< of the sum that this takes; 1 inside, 0.34 in a layer of two rows
  };
  struct Continued {
    std::int32_t stencil;
    Vec2 way = Vec2::Zero();       ///< from the particle to where the ghost's stress is that of the soil [m]
    Mat2 turn = Mat2::Identity();  ///< from there to the ghost, through walls that mirror the stress
    bool turned = false;
  };
  /// `left_out`: particles and ghosts that have no part.
  static OneSided one_sided(const ReferenceConfiguration& reference, std::int32_t particle,
                            const std::vector<std::uint8_t>& left_out, double spans_the_plane);
  static Continued continuation(const ReferenceConfiguration& reference, std::size_t ghost,
                                std::int32_t stencil);
  double trust(const OneSided& stencil) const;  ///< 0 to 1
  void sum_gradients(const PlaneTensors& piola);
  Mat2 extrapolated(const ReferenceConfiguration& reference, std::size_t k, const PlaneTensors& piola) const;
  Mat2 continued(const ReferenceConfiguration& reference, std::size_t k, const PlaneTensors& piola) const;

  std::vector<std::size_t> extrapolated_, mirrored_;  ///< ghosts of bearing walls, and the others
  std::vector<Continued> continued_;                  ///< beside extrapolated_
  std::vector<OneSided> stencils_;
  std::vector<std::array<Mat2, 2>> gradients_;  ///< of P along x and y, of each stencil
  bool flowed_ = false;
};

}  // namespace porosph
