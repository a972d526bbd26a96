#include "solver/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "solver/boundary/water_face.hpp"
#include "solver/case/check_boundaries.hpp"
#include "solver/case/inertia.hpp"
#include "solver/case/local_origin.hpp"
#include "solver/case/plausibility.hpp"
#include "solver/geometry/place_particles.hpp"
#include "solver/geometry/region.hpp"
#include "solver/model/initial_velocity.hpp"
#include "solver/model/soil_law.hpp"
#include "solver/water/steady_water.hpp"
#include "solver/water/still_water.hpp"
#include "solver/water/transient_water.hpp"

namespace porosph {
namespace {

/// Of a site that the water level may pass through, as if it were a square [N/m3].
double unit_weight(const SoilCase& soil, const StandingWater& water, const Site& site) {
  const double depth = water.depth(site.position.x(), site.position.y());
  const double wet = std::clamp(0.5 + depth / std::sqrt(site.area), 0.0, 1.0);
  return wet * soil.unit_weight_saturated + (1 - wet) * soil.unit_weight_unsaturated;
}

/// Where particles are, those of soils that are there. A site's number among those of all stages is its id.
struct Sites {
  std::vector<Site> sites;
  std::vector<std::int32_t> ids;
};

Sites sites_of(const Case& scene, const Point& origin) {
  Sites all{place_particles(scene.plan ? moved(*scene.plan, -origin) : scene), {}};
  all.ids.resize(all.sites.size());
  std::iota(all.ids.begin(), all.ids.end(), 0);
  if (!scene.plan) return all;
  std::vector<int> place;  // of the plan's soils in this case
  for (const SoilCase& soil : scene.plan->soils) {
    const auto found = std::ranges::find(scene.soils, soil.name, &SoilCase::name);
    place.push_back(found == scene.soils.end() ? -1 : static_cast<int>(found - scene.soils.begin()));
  }
  Sites present;
  for (std::size_t i = 0; i < all.sites.size(); ++i) {
    Site site = all.sites[i];
    if ((site.soil = place[site.soil]) < 0) continue;
    present.sites.push_back(site), present.ids.push_back(all.ids[i]);
  }
  return present;
}

Particles make_particles(const Case& scene, const StandingWater& water, const Sites& places) {
  Particles p;
  p.id = places.ids;
  for (const Site& site : places.sites) {
    const SoilCase& soil = scene.soils[site.soil];
    const double density = unit_weight(soil, water, site) / scene.loading.gravity;
    p.position.push_back(site.position);
    p.velocity.push_back(initial_velocity(soil, density, site.position));
    p.density.push_back(density);
    p.mass.push_back(density * site.area);
    p.fill.push_back(site.fill);
    p.soil.push_back(site.soil);
    p.pore_pressure.push_back(water.pore_pressure(site.position.x(), site.position.y()));
    p.stress.push_back({});
  }
  p.start = p.position;
  return p;
}

void check_every_soil_has_particles(const Case& scene, const Particles& particles) {
  for (std::size_t s = 0; s < scene.soils.size(); ++s)
    if (std::count(particles.soil.begin(), particles.soil.end(), static_cast<std::int32_t>(s)) == 0)
      throw std::runtime_error(fmt::format("soil '{}' holds no particle at a spacing of {} m",
                                           scene.soils[s].name, scene.particles.spacing));
}

/// Soil that falls begins without stress, and weighs on no other.
void add_k0_stress(const Case& scene, Particles& particles) {
  const std::vector<bool> falls = falling_soils(scene);
  Case carried = scene;
  for (std::size_t s = falls.size(); s-- > 0;)
    if (falls[s]) carried.soils.erase(carried.soils.begin() + static_cast<std::ptrdiff_t>(s));
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (falls[particles.soil[i]]) continue;
    const double nu = scene.soils[particles.soil[i]].poissons_ratio;
    const double k0 = scene.loading.k0 >= 0 ? scene.loading.k0 : nu / (1 - nu);
    particles.stress[i] = k0_stress(carried, particles.position[i], k0);
  }
}

std::vector<Wall> walls_of(const Case& scene, std::span<const Vec2> points) {
  std::vector<Region> soils;
  for (const SoilCase& soil : scene.soils) soils.emplace_back(soil.polygon, soil.holes);
  return make_walls(scene.boundaries, points, 2 * scene.smoothing_length(), [&](const Vec2& place) {
    return std::any_of(soils.begin(), soils.end(), [&](const Region& r) { return r.contains(place); });
  });
}

std::shared_ptr<FlowingWater> flowing_water(const Case& scene, const Particles& particles,
                                            const Vec2& origin) {
  if (scene.water.mode == WaterMode::steady || scene.flow)
    return std::make_shared<SteadyWater>(scene, particles, origin);
  if (scene.water.mode == WaterMode::transient)
    return std::make_shared<TransientWater>(scene, particles, origin);
  return nullptr;
}

Press press_of(const Case& scene) {
  // Loads that stages switch off would leave what the spring held, of which the next stage does not know.
  const bool loaded = !scene.loads.empty() && !scene.plan, footings = !scene.footings.empty();
  if (scene.water.couples())
    return (loaded || footings) && !scene.water.is_dynamic() ? Press::on_soil_and_water : Press::none;
  return footings || (loaded && scene.particles.arrangement == Arrangement::lattice) ? Press::on_soil
                                                                                     : Press::none;
}

}  // namespace

Model build_model(const Case& case_as_drawn) {
  Model model;
  model.origin = local_origin(case_as_drawn);
  const Case scene = moved(case_as_drawn, -model.origin);
  model.spacing = scene.particles.spacing;
  model.smoothing_length = scene.smoothing_length();
  model.water = StandingWater(scene.water);
  model.pore_water = std::make_shared<StillWater>();
  if (scene.loading.gravity_applied)
    model.gravity = scene.loading.gravity * Vec2(scene.loading.horizontal, -1);
  for (const SoilCase& s : scene.soils) {
    const std::int32_t id = s.id < 0 ? static_cast<std::int32_t>(model.soils.size()) : s.id;
    model.soils.emplace_back(soil_law(s, model.spacing), s.law != LawKind::elastic, id);
  }

  model.particles = make_particles(scene, model.water, sites_of(scene, model.origin));
  if (scene.soils.size() > 1) model.particles.interface_stress.assign(model.particles.size(), 0);
  check_every_soil_has_particles(scene, model.particles);
  if (scene.loading.k0_stress) add_k0_stress(scene, model.particles);
  for (std::size_t i = 0; i < model.soils.size(); ++i) {
    model.soils[i].add_history(model.particles);
    model.soils[i].start_history(model.particles, static_cast<std::int32_t>(i));
  }
  if (const auto water = flowing_water(scene, model.particles, model.origin)) {
    water->wet(scene, model.particles);
    model.pore_water = water;
  }
  model.walls = walls_of(scene, model.particles.position);
  model.visibility = Visibility(scene.soils, model.walls, model.particles, 2 * model.smoothing_length,
                                model.spacing, scene.sheets);
  if (std::ranges::any_of(model.walls, &Wall::is_periodic) && !model.visibility.everywhere())
    throw std::runtime_error(
        "periodic sides go with boundaries that meet at right angles around the soil alone, without slits");
  const std::vector<double> inertia = inertia_over_mass(scene);
  for (std::size_t i = 0; i < model.particles.size(); ++i) {
    const std::int32_t soil = model.particles.soil[i];
    const double modulus = model.soils[soil].constrained_modulus();
    model.wave_speed =
        std::max(model.wave_speed, std::sqrt(modulus / (model.particles.density[i] * inertia[soil])));
  }
  model.press = press_of(scene);
  model.loads = water_faces(scene, model.particles, 2 * model.smoothing_length);
  model.usual_cause = usual_cause_of_breakdown(scene);
  return model;
}

}  // namespace porosph
