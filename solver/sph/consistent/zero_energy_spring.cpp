#include "solver/sph/consistent/zero_energy_spring.hpp"

#include <algorithm>
#include <limits>

namespace porosph {
namespace {

/// s, by default where something sets off motion that alternates: soils that meet, cut cells, disorder.
double strength(const FormulationCase& formulation, bool cut, const ReferenceConfiguration& r,
                const OwnSides& sides) {
  constexpr double usual = 0.1;  // by the map cases/stability/disorder.toml
  if (formulation.zero_energy_stiffness >= 0) return formulation.zero_energy_stiffness;
  return r.closed() || !sides.empty() || cut ? usual : 0;
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
                                   bool cut, const ReferenceConfiguration& r, const OwnSides& sides)
    : place_(sides.place) {
  const Particles& p = model.particles;
  const double s = strength(formulation, cut, r, sides);
  active_ = s > 0 && formulation.zero_energy_control > 0;
  // mu = kappa rho c_p h
  const double rate_per_modulus = s / (rho_c * model.smoothing_length);
  for (const Soil& soil : model.soils)
    of_soil_.push_back(active_ ? rate_per_modulus * soil.constrained_modulus() : 0);
  const std::size_t n = r.particles();
  for (const std::int32_t a : sides.particle) {
    double least = of_soil_[p.soil[a]];
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry&) {
      const std::size_t root = static_cast<std::size_t>(b) < n ? b : r.ghosts.root(b - n);
      least = std::min(least, of_soil_[p.soil[root]]);
    });
    of_own_side_.push_back(least);
  }
  if (active_ && !sides.empty()) find_unequal_pairs(r, p);
}

void ZeroEnergySpring::find_unequal_pairs(const ReferenceConfiguration& r, const Particles& p) {
  const auto n = static_cast<std::int32_t>(r.particles());
  for (std::int32_t a = 0; a < n; ++a) {
    const std::size_t before = pairs_.size();
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      const std::int32_t root = b < n ? b : r.ghosts.root(b - n);
      if (of(root, p) != of(a, p)) pairs_.push_back({a, root, b < n ? -1 : b - n, g});
    });
    if (pairs_.size() > before) first_pair_.push_back(before);
  }
  first_pair_.push_back(pairs_.size());
}

void ZeroEnergySpring::visit(StateArchive& state, std::size_t particles) {
  bool slips = !slip_.empty();
  state.value("spring_slips", slips);
  if (!slips) return;
  slip_.resize(particles, Vec2::Zero());
  state.array("spring_slip", slip_);
}

}  // namespace porosph
