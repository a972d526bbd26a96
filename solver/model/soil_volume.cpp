#include "solver/model/soil_volume.hpp"

#include "solver/case/shapes.hpp"

namespace porosph {

std::vector<SoilVolume> soil_volumes(const Model& model, const Case& scene) {
  std::vector<SoilVolume> volumes;
  for (const SoilCase& soil : scene.soils) volumes.push_back({.drawn = area(soil)});
  for (std::size_t i = 0; i < model.particles.size(); ++i) {
    SoilVolume& of_soil = volumes[model.particles.soil[i]];
    of_soil.carried += model.particles.volume(i);
    of_soil.cells += model.spacing * model.spacing;
    ++of_soil.particles;
  }
  return volumes;
}

}  // namespace porosph
