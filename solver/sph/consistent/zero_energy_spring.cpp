#include "solver/sph/consistent/zero_energy_spring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace porosph {
namespace {

/// s, by default where something sets off motion that alternates: soils that meet, cut cells, the ends of
/// footings and of loads, and more of it disorder and walls at corners other than upright ones with the soil
/// between them. Soil that follows its water at rest needs it although it may yield: what alternates would
/// not come to rest, and so it would seem to fail.
double strength(const FormulationCase& formulation, const Model& model, bool cut,
                const ReferenceConfiguration& r) {
  constexpr double hardly = 0.01, least = 0.05, little = 0.1, usual = 0.2, more = 0.6;  // see docs/theory.md
  if (formulation.zero_energy_stiffness >= 0) return formulation.zero_energy_stiffness;
  const bool elastic = std::ranges::none_of(model.soils, &Soil::may_yield);
  if (r.closed() || !model.visibility.everywhere()) return elastic ? more : little;
  if (!r.own_sides.empty()) return elastic ? usual : little;
  if (cut || (model.press == Press::on_soil && elastic)) return little;
  if (model.press != Press::on_soil_and_water) return 0;
  return elastic ? least : hardly;
}

}  // namespace

bool cells_are_cut(const Particles& p) {
  double least = std::numeric_limits<double>::max(), most = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double whole = p.volume(a) / p.fill[a];
    least = std::min(least, whole), most = std::max(most, whole);
  }
  return least < 0.99 * most;
}

ZeroEnergySpring::ZeroEnergySpring(const FormulationCase& formulation, const Model& model, double rho_c,
                                   bool cut, const ReferenceConfiguration& r)
    : place_(r.own_sides.place) {
  const Particles& p = model.particles;
  const double s = strength(formulation, model, cut, r);
  active_ = s > 0 && formulation.zero_energy_control > 0;
  // mu = kappa rho c_p h
  const double rate_per_modulus = s / (rho_c * model.smoothing_length);
  for (const Soil& soil : model.soils)
    of_soil_.push_back(active_ ? rate_per_modulus * soil.constrained_modulus() : 0);
  const std::size_t n = r.particles();
  for (const std::int32_t a : r.own_sides.particle) {
    double least = of_soil_[p.soil[a]];
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry&) {
      const std::size_t root = static_cast<std::size_t>(b) < n ? b : r.ghosts.root(b - n);
      least = std::min(least, of_soil_[p.soil[root]]);
    });
    of_own_side_.push_back(least);
  }
  if (active_ && !r.own_sides.empty()) find_unequal_pairs(r, p);
}

/// With k of each particle, a pair's force on a is 2 w (k_b u_b - k_a u_a) - (k_a S_a + k_b S_b) G. With the
/// smaller of them for both, it lacks the part of the stiffer one's k that is beyond the softer one's.
void ZeroEnergySpring::find_unequal_pairs(const ReferenceConfiguration& r, const Particles& p) {
  const auto n = static_cast<std::int32_t>(r.particles());
  std::vector<std::int32_t> place(r.points.size(), -1);
  const auto place_of = [&](std::int32_t b) {
    if (place[b] < 0) {
      place[b] = static_cast<std::int32_t>(stiffer_.size());
      stiffer_.push_back(b < n ? Stiffer{b, -1} : Stiffer{r.ghosts.root(b - n), b - n});
    }
    return place[b];
  };
  for (std::int32_t a = 0; a < n; ++a) {
    const double own = of(a, p);
    const std::size_t first = excess_.size();
    Excess of_own{-1, 0, Vec2::Zero()};
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      const double other = of(b < n ? b : r.ghosts.root(b - n), p), excess = std::abs(other - own);
      if (other > own) {
        excess_.push_back({place_of(b), 2 * g.w * excess, excess * Vec2(g.x, g.y)});
      } else if (other < own) {
        of_own.motion -= 2 * g.w * excess, of_own.gradient += excess * Vec2(g.x, g.y);
      }
    });
    if (of_own.motion != 0) {
      of_own.stiffer = place_of(a);
      excess_.push_back(of_own);
    }
    if (excess_.size() > first) softened_.push_back({a, first});
  }
  softened_.push_back({-1, excess_.size()});
  strained_.resize(stiffer_.size());
}

void ZeroEnergySpring::add_softening(const ReferenceConfiguration& r, const Particles& p, double viscosity,
                                     std::span<Vec2> accelerations) const {
  const std::size_t count = softened_.empty() ? 0 : softened_.size() - 1;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < count; ++k) {
    Vec2 force = Vec2::Zero();
    for (std::size_t m = softened_[k].first; m < softened_[k + 1].first; ++m) {
      const Excess& e = excess_[m];
      const Strained& s = strained_[e.stiffer];
      force += s.gradient * e.gradient - e.motion * s.motion;
    }
    const std::int32_t a = softened_[k].particle;
    accelerations[a] += viscosity / (p.fill[a] * r.density[a]) * force;
  }
}

void ZeroEnergySpring::slip_by_half(const ReferenceConfiguration& r, std::span<const double> yields) {
  const auto n = static_cast<std::int32_t>(r.particles());
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    if (yields[a] == 0) continue;
    const Strained own = of_points_[a];
    Vec2 pull = Vec2::Zero();
    double all = 0;
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      const Strained& other = of_points_[b];
      pull += 2 * g.w * (other.motion - own.motion) - (own.gradient + other.gradient) * Vec2(g.x, g.y);
      all += 2 * g.w;
    });
    slip_[a] -= 0.5 / all * pull;
  }
}

void ZeroEnergySpring::visit(StateArchive& state, std::size_t particles) {
  bool slips = !slip_.empty();
  state.value("spring_slips", slips);
  if (!slips) return;
  slip_.resize(particles, Vec2::Zero());
  state.array("spring_slip", slip_);
}

}  // namespace porosph
