// The elastic part of the zero-energy control: a spring against displacements that alternate from particle to
// particle.
#pragma once

#include <span>
#include <vector>

#include "solver/sph/consistent/interface_gradients.hpp"
#include "solver/sph/consistent/reference.hpp"

namespace porosph {

/// The control acts on v + k u in place of v, u since the reference: with the viscosity mu, a spring of the
/// modulus mu k = kappa s M beside the dashpot. M is the modulus of the softest soil within the kernel's
/// reach, and pairs of particles with different k use the smaller: a stiff soil does not hold a soft one.
class ZeroEnergySpring {
 public:
  ZeroEnergySpring() = default;
  ZeroEnergySpring(const FormulationCase& formulation, const Model& model,
                   const ReferenceConfiguration& reference, const OwnSides& own_sides);

  bool active() const { return active_; }
  const std::vector<double>& of_soils() const { return of_soil_; }          ///< k away from other soils [1/s]
  const std::vector<double>& of_own_sides() const { return of_own_side_; }  ///< k of those in OwnSides [1/s]
  double of(std::size_t particle, const Particles& particles) const {       ///< k [1/s]
    const std::int32_t place = place_.empty() ? -1 : place_[particle];
    return place < 0 ? of_soil_[particles.soil[particle]] : of_own_side_[place];
  }

  /// Accelerations [m/s2] that give pairs of different k the smaller one, in place of each its own.
  /// `own_strain(a)` is F - I of a particle's own side, `viscosity` mu [Pa s].
  template <class OwnStrain>
  void soften_pairs(const ReferenceConfiguration& reference, const Particles& particles, double viscosity,
                    OwnStrain&& own_strain, std::span<Vec2> accelerations) const;

 private:
  struct UnequalPair {
    std::int32_t a, b;   ///< b: a particle, or the root of a ghost
    std::int32_t ghost;  ///< or -1
    PairGeometry geometry;
  };
  void find_unequal_pairs(const ReferenceConfiguration& reference, const Particles& particles);

  bool active_ = false;
  std::vector<double> of_soil_, of_own_side_;
  std::vector<std::int32_t> place_;
  std::vector<UnequalPair> pairs_;       ///< particle by particle
  std::vector<std::size_t> first_pair_;  ///< of each such particle, and one past the last
};

template <class OwnStrain>
void ZeroEnergySpring::soften_pairs(const ReferenceConfiguration& r, const Particles& p, double viscosity,
                                    OwnStrain&& own_strain, std::span<Vec2> accelerations) const {
  const auto moved = [&](std::int32_t a) { return Vec2(p.position[a] - r.points[a]); };
  const std::size_t count = first_pair_.empty() ? 0 : first_pair_.size() - 1;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t a = pairs_[first_pair_[k]].a;
    const double own_rate = of(a, p);
    const Vec2 own_motion = moved(a);
    const Mat2 strain = own_strain(a);
    Vec2 force = Vec2::Zero();
    for (std::size_t m = first_pair_[k]; m < first_pair_[k + 1]; ++m) {
      const UnequalPair& pair = pairs_[m];
      Vec2 motion = moved(pair.b);
      Mat2 other_strain = own_strain(pair.b);
      if (pair.ghost >= 0) {
        motion = r.ghosts.from_root<Mirrors::motion>(pair.ghost, motion);
        other_strain = r.ghosts.flux_from_root(pair.ghost, other_strain);
      }
      const double other_rate = of(pair.b, p), smaller = std::min(own_rate, other_rate);
      const double own = smaller - own_rate, other = smaller - other_rate;
      const PairGeometry& g = pair.geometry;
      force += 2 * g.w * (other * motion - own * own_motion) -
               (own * strain + other * other_strain) * Vec2(g.x, g.y);
    }
    accelerations[a] += viscosity / (p.fill[a] * r.density[a]) * force;
  }
}

}  // namespace porosph
