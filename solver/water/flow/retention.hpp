// How permeability and degree of saturation depend on the pressure head.
#pragma once

#include "solver/case/flow_case.hpp"

namespace porosph {

/// Relative permeability kr and effective saturation Se of a soil over the pressure head psi [m], both 1
/// where psi >= 0. Sources: Gardner 1958 (Soil Sci. 85); van Genuchten 1980 (Soil Sci. Soc. Am. J. 44).
class Retention {
 public:
  static constexpr double least = 1e-12;  ///< kr never falls below, so that every particle has an equation

  Retention() = default;
  /// `spacing` of the particles [m]: the height over which the saturated model's kr falls.
  Retention(const RetentionCase& soil, double spacing) : soil_(soil), height_(spacing) {}

  struct Permeability {
    double kr;     ///< [-]
    double slope;  ///< dkr/dpsi [1/m]
  };
  Permeability permeability(double psi) const;
  /// Whether Se is a smooth curve that has no end.
  bool is_curved() const {
    return soil_.model == RetentionModel::gardner || soil_.model == RetentionModel::van_genuchten;
  }
  double saturation(double psi) const;  ///< Se [-]
  struct Stored {
    double saturation;  ///< [-]
    double slope;       ///< dSe/dpsi [1/m]
  };
  /// Se as the water's balance counts it: soil without a retention curve drains within one spacing.
  Stored stored(double psi) const;
  /// The psi < 0 at which that is `saturation`, above 0 and below 1; the curve's end where it ends above [m].
  double pressure_head(double saturation) const;
  /// chi psi with Bishop's chi = Se: the pressure head as the soil's stress feels it; no suction without a
  /// retention curve [m].
  double effective(double psi) const { return psi >= 0 ? psi : saturation(psi) * psi; }

 private:
  RetentionCase soil_;
  double height_ = 1;
};

}  // namespace porosph
