// The elastic part of the zero-energy control: a spring against displacements that alternate from particle to
// particle.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "solver/particles/state.hpp"
#include "solver/sph/consistent/interface_gradients.hpp"
#include "solver/sph/consistent/reference.hpp"

namespace porosph {

/// The control acts on v + k u in place of v, u since the reference: with the viscosity mu, a spring of the
/// modulus mu k = kappa s M beside the dashpot. M is the modulus of the softest soil within the kernel's
/// reach, and pairs of particles with different k use the smaller: a stiff soil does not hold a soft one.
///
/// A spring that never yields would be a strength that the soil has not. Where the soil yields, the spring
/// slips: it acts on u - p, and p takes up half of what pulls the particle back in every such step.
class ZeroEnergySpring {
 public:
  ZeroEnergySpring() = default;
  /// `rho_c` as in the control's viscosity, kappa rho c_p h [kg/(m2 s)].
  ZeroEnergySpring(const FormulationCase& formulation, const Model& model, double rho_c, bool cells_are_cut,
                   const ReferenceConfiguration& reference, const OwnSides& own_sides);

  bool active() const { return active_; }
  const std::vector<double>& of_soils() const { return of_soil_; }          ///< k away from other soils [1/s]
  const std::vector<double>& of_own_sides() const { return of_own_side_; }  ///< k of those in OwnSides [1/s]
  double of(std::size_t particle, const Particles& particles) const {       ///< k [1/s]
    const std::int32_t place = place_.empty() ? -1 : place_[particle];
    return place < 0 ? of_soil_[particles.soil[particle]] : of_own_side_[place];
  }

  /// u - p since the reference, what the spring is stretched by [m].
  Vec2 stretch(std::size_t particle, const ReferenceConfiguration& reference,
               const Particles& particles) const {
    const Vec2 u = particles.position[particle] - reference.points[particle];
    return slip_.empty() ? u : Vec2(u - slip_[particle]);
  }

  /// Lets the spring slip where `yields` is not 0, after a step.
  template <class OwnStrain>
  void slip(const ReferenceConfiguration& reference, const Particles& particles,
            std::span<const double> yields, OwnStrain&& own_strain);
  void visit(StateArchive& state, std::size_t particles);  ///< saves or restores p

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
  std::vector<Vec2> slip_;               ///< p of each particle [m]; empty where none has yielded
};

/// The outline cuts cells: cells of unequal size do not close the sums of their gradients.
bool cells_are_cut(const Particles& at_start);

template <class OwnStrain>
void ZeroEnergySpring::slip(const ReferenceConfiguration& r, const Particles& p,
                            std::span<const double> yields, OwnStrain&& own_strain) {
  constexpr double share = 0.5;
  if (std::ranges::all_of(yields, [](double y) { return y == 0; })) return;
  const auto n = static_cast<std::int32_t>(r.particles());
  slip_.resize(n, Vec2::Zero());
  std::vector<Vec2> change(n, Vec2::Zero());
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    if (yields[a] == 0) continue;
    const Vec2 own = stretch(a, r, p);
    const Mat2 own_gradient = own_strain(a);
    Vec2 pull = Vec2::Zero();
    double all = 0;
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      const std::int32_t root = b < n ? b : r.ghosts.root(b - n);
      Vec2 other = stretch(root, r, p);
      Mat2 other_gradient = own_strain(root);
      if (b >= n) {
        other = r.ghosts.from_root<Mirrors::motion>(b - n, other);
        other_gradient = r.ghosts.flux_from_root(b - n, other_gradient);
      }
      pull += 2 * g.w * (other - own) - (own_gradient + other_gradient) * Vec2(g.x, g.y);
      all += 2 * g.w;
    });
    change[a] = share / all * pull;
  }
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) slip_[a] -= change[a];
}

template <class OwnStrain>
void ZeroEnergySpring::soften_pairs(const ReferenceConfiguration& r, const Particles& p, double viscosity,
                                    OwnStrain&& own_strain, std::span<Vec2> accelerations) const {
  const auto moved = [&](std::int32_t a) { return stretch(a, r, p); };
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
