#include "solver/model/soil_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/case/shapes.hpp"

namespace porosph {
namespace {

constexpr double degree = std::numbers::pi / 180;

double reduced_angle(double angle, double reduction) {
  return std::atan(std::tan(angle * degree) / reduction) / degree;
}

/// Per plastic strain of a particle, which laws measure by sqrt(2/3 de : de), shear strain over sqrt(3).
Softening softening_of(const StrengthCase& c, double spacing) {
  if (c.softening == SofteningKind::none) return {};
  const double rate = std::numbers::sqrt3 / c.softening_strain * spacing / c.softening_length;
  return c.softening == SofteningKind::linear ? Softening{0, rate} : Softening{rate, 0};
}

/// The law with the strength c, phi, psi and tension of the case.
template <class Make>
auto frictional(const StrengthCase& c, double spacing, double reduction, Make&& make) {
  const double phi = reduced_angle(c.friction_angle, reduction);
  auto peak = make(c.cohesion / reduction, phi, std::min(c.dilation_angle, phi),
                   std::min(c.tensile_strength / reduction, std::numeric_limits<double>::max()));
  peak.dilation_limit = c.dilation_limit;
  if (c.softening == SofteningKind::none) return peak;
  return peak.softened_to(c.residual_cohesion / reduction,
                          reduced_angle(c.residual_friction_angle, reduction), softening_of(c, spacing));
}

Tresca tresca(const SoilCase& soil, const Elasticity& elastic, double spacing, double reduction) {
  const StrengthCase& c = soil.strength;
  Tresca law{elastic};
  law.strength = c.undrained_strength, law.growth = c.growth;
  law.level = c.level < never ? c.level : highest_point(soil);
  law.reduction = 1 / reduction;
  law.tension = std::min(c.tensile_strength / reduction, std::numeric_limits<double>::max());
  law.softening = softening_of(c, spacing);
  law.residual = c.softening == SofteningKind::none ? 1 : 1 / c.sensitivity;
  return law;
}

CamClay cam_clay(const SoilCase& soil, const Elasticity& elastic, double reduction) {
  const CamClayCase& c = soil.cam_clay;
  const double sine = 3 * c.ratio / (6 + c.ratio);
  const double reduced = std::sin(std::atan(std::tan(std::asin(sine)) / reduction));
  CamClay law{elastic};
  law.ratio = reduction == 1 ? c.ratio : 6 * reduced / (3 - reduced);
  law.compressibility = c.lambda / (1 + c.void_ratio), law.swelling = c.kappa / (1 + c.void_ratio);
  law.shear_ratio = elastic.shear_modulus / elastic.bulk_modulus;
  law.attraction = c.attraction, law.void_ratio = c.void_ratio;
  law.preconsolidation = c.preconsolidation, law.overconsolidation = c.overconsolidation;
  return law;
}

MohrCoulomb mohr_coulomb(const SoilCase& soil, const Elasticity& elastic, double spacing, double reduction) {
  return frictional(soil.strength, spacing, reduction,
                    [&](auto... strength) { return MohrCoulomb::from_angles(elastic, strength...); });
}

}  // namespace

AnyLaw soil_law(const SoilCase& soil, double spacing, double reduction) {
  const Elasticity elastic = Elasticity::from_young(soil.youngs_modulus, soil.poissons_ratio);
  switch (soil.law) {
    case LawKind::drucker_prager:
      return frictional(soil.strength, spacing, reduction, [&](auto... strength) {
        return DruckerPrager::from_mohr_coulomb(elastic, strength...);
      });
    case LawKind::mohr_coulomb:
      return mohr_coulomb(soil, elastic, spacing, reduction);
    case LawKind::byrne:
      return Byrne{mohr_coulomb(soil, elastic, spacing, reduction), soil.compaction.c1, soil.compaction.c2,
                   soil.compaction.threshold};
    case LawKind::tresca:
      return tresca(soil, elastic, spacing, reduction);
    case LawKind::cam_clay:
      return cam_clay(soil, elastic, reduction);
    case LawKind::elastic:
      break;
  }
  if (soil.no_tension) return NoTension{elastic};
  return LinearElastic{elastic};
}

void reduce_strength(Model& model, const Case& scene, double factor) {
  for (std::size_t i = 0; i < model.soils.size(); ++i) {
    Soil changed(soil_law(scene.soils[i], model.spacing, factor), model.soils[i].flows(),
                 model.soils[i].id());
    changed.add_history(model.particles);
    model.soils[i] = std::move(changed);
  }
}

}  // namespace porosph
