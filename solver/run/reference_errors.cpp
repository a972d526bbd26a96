#include "solver/run/reference_errors.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "solver/reference/exact/conventional_column.hpp"
#include "solver/reference/exact/finite_strain_column.hpp"

namespace porosph {
namespace {

struct Ground {
  double bottom = never, top = -never;
};

Ground ground_of(const Case& scene) {
  if (scene.soils.size() != 1)
    throw std::runtime_error("the reference 'column' describes one soil; this case has several");
  Ground ground;
  for (const Point& p : scene.soils[0].polygon) {
    ground.bottom = std::min(ground.bottom, p.y());
    ground.top = std::max(ground.top, p.y());
  }
  return ground;
}

ErrorNorms norms(const Particles& p, const std::function<double(std::size_t)>& computed,
                 const std::function<double(std::size_t)>& exact) {
  double difference = 0, reference = 0, largest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double d = computed(i) - exact(i), volume = p.volume(i);
    difference += volume * d * d;
    reference += volume * exact(i) * exact(i);
    largest = std::max(largest, std::abs(d));
  }
  return {std::sqrt(difference / reference), largest};
}

}  // namespace

ReferenceColumn reference_column(const Case& scene) {
  const Ground ground = ground_of(scene);
  const SoilCase& soil = scene.soils[0];
  const Elasticity elastic = Elasticity::from_young(soil.youngs_modulus, soil.poissons_ratio);
  Column column{.height = ground.top - ground.bottom,
                .bulk_modulus = elastic.bulk_modulus,
                .shear_modulus = elastic.shear_modulus,
                .unit_weight_saturated = soil.unit_weight_saturated,
                .unit_weight_unsaturated = soil.unit_weight_unsaturated,
                .unit_weight_water = scene.water.unit_weight};
  if (scene.water.present())
    column.water_level = at_rest_from(scene.water, scene.time.end).stretches[0].level - ground.bottom;
  return {column, ground.bottom};
}

namespace {

FiniteStrainColumn exact_column(const Case& scene, const Column& column) {
  return scene.reference == Reference::conventional_column ? conventional_column(column)
                                                           : FiniteStrainColumn(column);
}

}  // namespace

std::vector<Stress> reference_stress(const Simulation& simulation) {
  const Case& scene = simulation.scene();
  if (scene.reference == Reference::none) throw std::runtime_error("the case names no reference");
  const auto [column, bottom] = reference_column(scene);
  const FiniteStrainColumn exact = exact_column(scene, column);
  std::vector<Stress> stress;
  for (const Vec2& start : simulation.model().particles.start) {
    const double height = start.y() + simulation.model().origin.y() - bottom,
                 lateral = exact.lateral_stress(height);
    stress.push_back({lateral, exact.vertical_stress(height), lateral, 0});
  }
  return stress;
}

std::map<std::string, ErrorNorms> reference_errors(const Simulation& simulation) {
  const Case& scene = simulation.scene();
  if (scene.reference == Reference::none) return {};
  const auto [column, bottom] = reference_column(scene);
  const FiniteStrainColumn exact = exact_column(scene, column);
  const Particles& p = simulation.model().particles;
  const auto height = [&p, low = bottom - simulation.model().origin.y()](std::size_t i) {
    return p.start[i].y() - low;
  };
  const auto lateral = [&](std::size_t i) { return exact.lateral_stress(height(i)); };
  return {
      {"EffectiveStress_XX", norms(
                                 p, [&](auto i) { return p.stress[i].xx; }, lateral)},
      {"EffectiveStress_YY", norms(
                                 p, [&](auto i) { return p.stress[i].yy; },
                                 [&](auto i) { return exact.vertical_stress(height(i)); })},
      {"EffectiveStress_ZZ", norms(
                                 p, [&](auto i) { return p.stress[i].zz; }, lateral)},
      {"Displacement_Y", norms(
                             p, [&](auto i) { return p.displacement(i).y(); },
                             [&](auto i) { return exact.displacement(height(i)); })},
  };
}

}  // namespace porosph
