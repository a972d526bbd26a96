#include "solver/run/drainage.hpp"

#include "solver/case/pores.hpp"
#include "solver/water/flow/default_faces.hpp"

namespace porosph {

DarcyFlow saturated_flow(const std::vector<SoilCase>& soils, const HydraulicOutline& outline,
                         const Particles& p, double spacing) {
  const std::vector<double> below(p.size(), -1e9);
  return {make_flow_pairs(soils, outline, p, spacing), outline, std::vector<Retention>(soils.size()), p.soil,
          below};
}

std::optional<Drainage> drainage(const Case& scene, const Particles& p) {
  if (scene.water.mode != WaterMode::coupled) return std::nullopt;
  const std::vector<HydraulicFaceCase> faces = faces_of_excess(scene);
  const HydraulicOutline outline =
      hydraulic_outline(scene.soils, faces, scene.particles.spacing, scene.boundaries);
  Drainage d{.outline = outline,
             .faces = FaceConditions(outline, faces, true),
             .flow = saturated_flow(scene.soils, outline, p, scene.particles.spacing)};
  d.pinned = d.flow.pinning_patches(d.faces);
  return d;
}

PressureStabilisation pressure_stabilisation(const Case& scene, std::span<const double> tau,
                                             const Particles& particles) {
  std::vector<SoilCase> soils = scene.soils;
  const double spacing = scene.particles.spacing;
  for (std::size_t i = 0; i < soils.size(); ++i) soils[i].permeability = Point::Constant(tau[i]);
  const HydraulicOutline outline =
      hydraulic_outline(soils, {{.kind = FaceKind::closed}}, spacing, scene.boundaries);
  return {saturated_flow(soils, outline, particles, spacing), outline, particles.position};
}

std::vector<double> storage_of_water(const Case& scene, const Particles& p) {
  std::vector<double> storage;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double porosity = porosity_of(scene.soils[p.soil[a]]);
    storage.push_back(scene.water.unit_weight * porosity * p.volume(a) / scene.water.coupling.bulk_modulus);
  }
  return storage;
}

}  // namespace porosph
