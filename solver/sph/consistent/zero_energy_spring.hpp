// The elastic part of the zero-energy control: a spring against displacements that alternate from particle to
// particle.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "solver/particles/state.hpp"
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
                   const ReferenceConfiguration& reference);

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
                    OwnStrain&& own_strain, std::span<Vec2> accelerations);

 private:
  /// A particle, or the ghost that stems from it, that has a neighbour with a smaller k.
  struct Stiffer {
    std::int32_t particle;
    std::int32_t ghost;  ///< or -1
  };
  struct Strained {
    Vec2 motion;    ///< u - p [m]
    Mat2 gradient;  ///< own side's F - I
  };
  /// What a pair's force is too large by, for the motion and the gradient of one of them: 2 w k and G k.
  struct Excess {
    std::int32_t stiffer;  ///< place in stiffer_
    double motion;
    Vec2 gradient;
  };
  /// All that acts on one particle.
  struct Softened {
    std::int32_t particle;
    std::size_t first;  ///< in excess_, up to that of the next
  };
  void find_unequal_pairs(const ReferenceConfiguration& reference, const Particles& particles);
  void add_softening(const ReferenceConfiguration& reference, const Particles& particles, double viscosity,
                     std::span<Vec2> accelerations) const;

  bool active_ = false;
  std::vector<double> of_soil_, of_own_side_;
  std::vector<std::int32_t> place_;
  std::vector<Stiffer> stiffer_;
  std::vector<Strained> strained_;  ///< of each in stiffer_
  std::vector<Softened> softened_;  ///< and one past the last
  std::vector<Excess> excess_;
  std::vector<Vec2> slip_;  ///< p of each particle [m]; empty where none has yielded
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
                                    OwnStrain&& own_strain, std::span<Vec2> accelerations) {
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < stiffer_.size(); ++k) {
    const auto [particle, ghost] = stiffer_[k];
    const Vec2 motion = stretch(particle, r, p);
    const Mat2 gradient = own_strain(particle);
    strained_[k] = ghost < 0 ? Strained{motion, gradient}
                             : Strained{r.ghosts.from_root<Mirrors::motion>(ghost, motion),
                                        r.ghosts.flux_from_root(ghost, gradient)};
  }
  add_softening(r, p, viscosity, accelerations);
}

}  // namespace porosph
