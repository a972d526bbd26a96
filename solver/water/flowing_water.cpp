#include "solver/water/flowing_water.hpp"

#include <algorithm>
#include <cmath>

#include "solver/water/flow/default_faces.hpp"
#include "solver/water/flow/drains.hpp"
#include "solver/water/flow/steady_seepage.hpp"

namespace porosph {

FlowingWater::FlowingWater(const Case& scene, const Particles& p, const Vec2& origin)
    : faces_(faces_of_seepage(scene)),
      first_named_(faces_.size() - scene.water.faces.size()),
      outline_(hydraulic_outline(scene.soils, faces_, scene.particles.spacing)),
      flow_(make_flow(scene, p, origin)),
      origin_(origin),
      unit_weight_(scene.water.unit_weight),
      weighs_by_saturation_(scene.water.mode == WaterMode::transient),
      place_(p.position) {
  for (const std::int32_t soil : p.soil) permeability_.push_back(scene.soils[soil].permeability);
  for (const FlowSectionCase& section : scene.sections) sections_.emplace_back(section, flow_, p.position);
}

DarcyFlow FlowingWater::make_flow(const Case& scene, const Particles& p, const Vec2& origin) {
  FlowPairs pairs = make_flow_pairs(scene.soils, outline_, p, scene.particles.spacing);
  add_drains(scene, p, origin, faces_, outline_, pairs);
  std::vector<Retention> retention;
  for (const SoilCase& soil : scene.soils) retention.emplace_back(soil.retention, scene.particles.spacing);
  std::vector<double> height;
  for (const Vec2& x : p.position) height.push_back(x.y());
  return {std::move(pairs), outline_, std::move(retention), p.soil, height};
}

std::vector<int> FlowingWater::face_of_patch() const {
  std::vector<int> face;
  for (const HydraulicPatch& patch : outline_.patches)
    face.push_back(std::max(-1, patch.face - static_cast<int>(first_named_)));
  return face;
}

std::vector<double> FlowingWater::through_faces(std::span<const double> head,
                                                const FaceConditions& faces) const {
  const std::vector<double> all = porosph::through_faces(flow_, outline_, head, faces, faces_.size());
  return {all.begin() + static_cast<std::ptrdiff_t>(first_named_), all.end()};
}

void FlowingWater::tell(std::vector<double> head, const FaceConditions& faces) {
  record_.head = std::move(head);
  record_.velocity = flow_.velocities(record_.head, faces, place_);
  record_.gradient = flow_.velocities(record_.head, faces, place_, true);
  record_.saturation.resize(place_.size());
  for (std::size_t a = 0; a < place_.size(); ++a) {
    record_.gradient[a] = record_.gradient[a].cwiseQuotient(permeability_[a]);
    record_.saturation[a] = flow_.retention(a).saturation(record_.head[a] - place_[a].y());
  }
  record_.through_sections = through_sections(record_.head, faces);
}

std::vector<double> FlowingWater::through_sections(std::span<const double> head,
                                                   const FaceConditions& faces) const {
  std::vector<double> through;
  for (const SectionFlow& section : sections_) through.push_back(section.discharge(flow_, head, faces));
  return through;
}

double FlowingWater::unit_weight(const SoilCase& soil, std::size_t a, double area, const Vec2& place) const {
  const double psi = pressure_head(a, place);
  const bool by_depth = !weighs_by_saturation_ || soil.retention.model == RetentionModel::saturated;
  const double part =
      by_depth ? std::clamp(0.5 + psi / std::sqrt(area), 0.0, 1.0) : flow_.retention(a).saturation(psi);
  return part * soil.unit_weight_saturated + (1 - part) * soil.unit_weight_unsaturated;
}

void FlowingWater::wet(const Case& scene, Particles& p) const {
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double area = p.volume(a);
    p.density[a] = unit_weight(scene.soils[p.soil[a]], a, area, p.position[a]) / scene.loading.gravity;
    p.mass[a] = p.density[a] * area;
    p.pore_pressure[a] = -unit_weight_ * flow_.retention(a).effective(record_.head[a] - p.position[a].y());
  }
}

void FlowingWater::follow(const StandingWater&, Particles& p, std::size_t first, std::size_t last) const {
  for (std::size_t a = first; a < last; ++a)
    p.pore_pressure[a] = -unit_weight_ * flow_.retention(a).effective(pressure_head(a, p.position[a]));
}

void FlowingWater::take_along(const Particles& p) {
  std::vector<double> psi;
  for (std::size_t a = 0; a < p.size(); ++a) psi.push_back(record_.head[a] - p.position[a].y());
  taken_along_ = std::move(psi);
}

void FlowingWater::visit_taken_along(StateArchive& state) {
  bool taken = is_taken_along();
  state.value("flow_taken_along", taken);
  taken_along_.resize(taken ? place_.size() : 0);
  state.array("flow_taken_along_psi", taken_along_);
}

void FlowingWater::fill_ghosts(const StandingWater&, const Particles& p, const Ghosts& ghosts,
                               std::span<const Vec2> places, std::span<double> pressure) const {
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    const auto root = static_cast<std::size_t>(ghosts.root(i));
    const double head = pressure_head(root, p.position[root]) + p.position[root].y() -
                        record_.gradient[root].dot(places[i] - p.position[root]);
    pressure[p.size() + i] = -unit_weight_ * flow_.retention(root).effective(head - places[i].y());
  }
}

}  // namespace porosph
