#include "solver/run/pore_permeability.hpp"

#include <algorithm>
#include <stdexcept>

#include "solver/case/pores.hpp"
#include "solver/space/place_text.hpp"
#include "solver/water/flow/kozeny_carman.hpp"

namespace porosph {

PorePermeability::PorePermeability(const std::vector<SoilCase>& soils, const Particles& p) {
  const auto does = [](const SoilCase& s) { return s.permeability_law == PermeabilityLaw::kozeny_carman; };
  if (std::ranges::none_of(soils, does)) return;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const SoilCase& soil = soils[p.soil[a]];
    porosity_.push_back(does(soil) ? porosity_of(soil) : 0);
    volume_.push_back(p.volume(a));
  }
  ratio_.assign(p.size(), 1);
}

void PorePermeability::follow(std::span<const double> gained) {
  double least = 1;
#pragma omp parallel for schedule(static) reduction(min : least)
  for (std::size_t a = 0; a < ratio_.size(); ++a) {
    if (porosity_[a] == 0) continue;
    const double porosity = porosity_after(porosity_[a], 1 + gained[a] / volume_[a]);
    ratio_[a] = kozeny_carman(porosity_[a], porosity);
    least = std::min(least, porosity);
  }
  if (!(least > 0))
    throw std::runtime_error(
        "soil.permeability_law = \"kozeny_carman\": the soil is compressed so far that it has no pores left: "
        "soil.porosity is too small, or the soil too soft for its load");
}

}  // namespace porosph
