// How permeability changes with the pores.
#pragma once

namespace porosph {

/// Part of the soil that is pores after its volume has changed by a factor; its grains keep theirs. Not above
/// 0 once they fill the soil.
inline double porosity_after(double porosity, double volume_ratio) {
  return 1 - (1 - porosity) / volume_ratio;
}

/// k ~ n^3 / (1 - n)^2, over that of the porosity at the start. Sources: Kozeny 1927, Sitzungsber. Akad.
/// Wiss. Wien 136; Carman 1937, Trans. Inst. Chem. Eng. 15.
inline double kozeny_carman(double porosity_at_start, double porosity) {
  const double pores = porosity / porosity_at_start, grains = (1 - porosity_at_start) / (1 - porosity);
  return pores * pores * pores * grains * grains;
}

}  // namespace porosph
