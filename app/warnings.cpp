#include "app/warnings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "solver/boundary/water_face.hpp"
#include "solver/case/known_limits.hpp"
#include "solver/case/plausibility.hpp"
#include "solver/model/soil_volume.hpp"

namespace porosph::app {
namespace {

constexpr double tolerable_misfit = 0.01;  // of a soil's area: the stress is off by as much, or more

void check_volumes(const Model& model, const Case& scene, std::vector<std::string>& out) {
  const std::vector<SoilVolume> volumes = soil_volumes(model, scene);
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const SoilVolume& v = volumes[i];
    if (std::abs(v.carried - v.drawn) > tolerable_misfit * v.drawn)
      out.push_back(fmt::format("soil '{}': its particles carry {:.4g} m2 of the {:.4g} m2 drawn",
                                scene.soils[i].name, v.carried, v.drawn));
    if (scene.particles.arrangement == Arrangement::lattice &&
        std::abs(v.cells - v.drawn) > tolerable_misfit * v.drawn)
      out.push_back(fmt::format(
          "particles.arrangement = \"lattice\" with particles.spacing = {:g} m: the cells of soil '{}' cover "
          "{:.4g} m2 of the {:.4g} m2 drawn; its particles carry the drawn volume, but lie where it is not. "
          "\"stretched\" or \"surface\" fits the outline, or a spacing that divides its sides",
          scene.particles.spacing, scene.soils[i].name, v.cells, v.drawn));
  }
}

void check_stretches(const Model& model, const Case& scene, std::vector<std::string>& out) {
  const std::vector<WaterStretch>& stretches = scene.water.stretches;
  if (stretches.size() == 1 && stretches[0].x_from == -never && stretches[0].x_to == never)
    return;  // all dry
  std::vector<char> wets(stretches.size());
  for (std::size_t i = 0; i < model.particles.size(); ++i) {
    const int stretch = model.water.stretch_at(model.particles.position[i].x());
    if (stretch >= 0 && model.particles.pore_pressure[i] < 0) wets[stretch] = true;
  }
  for (const LoadedSurface& surface : model.loads)
    if (const auto* water = dynamic_cast<const WaterOnFace*>(surface.load.get()))
      wets[water->outside()] = true;
  for (std::size_t i = 0; i < stretches.size(); ++i)
    if (!wets[i])
      out.push_back(
          fmt::format("water.stretches[{}]: no particle lies below its level, y = {:.10g} m: it does "
                      "nothing",
                      i, stretches[i].level));
}

}  // namespace

std::vector<std::string> warnings_of(const Case& scene) {
  std::vector<std::string> warnings = known_failures(scene);
  for (std::string& text : doubtful_values(scene)) warnings.push_back(std::move(text));
  return warnings;
}

std::vector<std::string> warnings_of(const Model& model, const Case& scene) {
  std::vector<std::string> warnings;
  check_volumes(model, scene, warnings);
  check_stretches(model, scene, warnings);
  return warnings;
}

std::vector<std::string> warnings_of_end(const Simulation& s) {
  const double spacing = s.scene().particles.spacing, moved = s.largest_displacement();
  if (s.seepage() == nullptr || s.in_motion() || s.instability() || moved < spacing) return {};
  return {
      fmt::format("soil has moved by up to {:.3g} m, more than the spacing of {:g} m, and yet came to rest "
                  "at every output: it may have slid. Smaller particles may show that it loses its "
                  "equilibrium",
                  moved, spacing)};
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings) std::cerr << "porosph: warning: " << text << '\n';
}

void warn_of_smaller_steps(const Simulation& simulation) {
  const double asked = simulation.scene().time.courant;
  if (simulation.courant() < asked)
    std::cerr << fmt::format(
        "porosph: note: the stiffest of the particles allows time.courant = {:.3g}, which is taken in place "
        "of "
        "{:g}\n",
        simulation.courant(), asked);
}

}  // namespace porosph::app
