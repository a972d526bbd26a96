#include "solver/run/water_stencils.hpp"

#include <cmath>
#include <numeric>

namespace porosph {
namespace {

/// What mirrors soil that has left its outline: closed stretches.
HydraulicOutline outline_of(const std::vector<Wall>& walls) {
  HydraulicOutline outline;
  outline.stretches = walls;
  outline.first = {0};
  for (std::size_t i = 0; i < walls.size(); ++i) {
    outline.patches.push_back(
        {.stretch = static_cast<int>(i), .from = 0, .to = (walls[i].to - walls[i].from).norm(), .face = 0});
    outline.first.push_back(static_cast<std::int32_t>(i + 1));
  }
  return outline;
}

DarcyFlow flow_of_moved(const std::vector<SoilCase>& soils, const HydraulicOutline& walls, const Particles& p,
                        double spacing) {
  const std::vector<double> below(p.size(), -1e9);
  const std::vector<Retention> full(soils.size());
  return {make_flow_pairs_of_moved(soils, walls, p, spacing), walls, full, p.soil, below};
}

}  // namespace

WaterStencils::WaterStencils(const Case& scene, const Model& model)
    : soils_(scene.soils),
      of_inertia_(scene.soils),
      walls_(outline_of(model.walls)),
      spacing_(model.spacing),
      drainage_(drainage(scene, model.particles)),
      pores_(scene.soils, model.particles) {
  std::vector<double> tau;
  for (const SoilCase& soil : soils_)
    tau.push_back(scene.water.unit_weight * scene.loading.gravity / soil.unit_weight_saturated);
  for (std::size_t i = 0; i < tau.size(); ++i) of_inertia_[i].permeability = Point::Constant(tau[i]);
  inertia_ = pressure_stabilisation(scene, tau, model.particles);
  take_slope(model.particles.size());
}

void WaterStencils::renew(const Particles& p) {
  made_at_ = p.position;
  density_then_ = p.density;
  make(p);
}

void WaterStencils::make(const Particles& p) {
  if (drainage_)
    drainage_ = Drainage{.outline = walls_,
                         .faces = FaceConditions(walls_, {{.kind = FaceKind::closed}}, true),
                         .flow = flow_of_moved(soils_, walls_, p, spacing_),
                         .pinned = std::vector<std::int32_t>(p.size(), -1)};
  inertia_ = {flow_of_moved(of_inertia_, walls_, p, spacing_), walls_, p.position};
  find_free_surface(p);
  take_slope(p.size());
}

bool WaterStencils::follow_pores(std::span<const double> gained) {
  if (!pores_.follows()) return false;
  pores_.follow(gained);
  take_slope(gained.size());
  return true;
}

/// Saturated flow is linear: its rates at h = 0 and its slope are all of it.
void WaterStencils::take_slope(std::size_t n) {
  still_inflow_.assign(n, 0);
  if (!drainage_) return;
  drainage_->flow.set_permeability_ratio(pores_.ratio());
  const std::vector<double> zero(n, 0);
  drainage_->flow.assemble(zero, drainage_->faces, DarcyFlow::Slope::secant, slope_, still_inflow_);
}

double WaterStencils::through_faces(std::span<const double> head) const {
  if (!drainage_) return 0;
  const std::vector<double> through = drainage_->flow.through_patches(head, drainage_->faces);
  return std::accumulate(through.begin(), through.end(), 0.0);
}

/// Half of what surrounds a particle inside is missing there. Its pairs lead as much to it, per gradient, as
/// is to flow out: that leaves a uniform gradient in balance. Particles inside have no outlet, however
/// irregular they lie.
void WaterStencils::find_free_surface(const Particles& p) {
  constexpr double open = 0.75, whole = 0.75;
  free_ = {};
  if (!drainage_) return;
  const FlowPairs& flow = drainage_->flow.pairs();
  free_.outlet.assign(p.size(), 0), free_.holds.assign(p.size(), 0);
  for (std::size_t a = 0; a < p.size(); ++a) {
    if (flow.enclosed[a] > open) continue;
    free_.holds[a] = p.fill[a] < whole;
    Vec2 inwards = Vec2::Zero();
    for (auto k = flow.begin[a]; k < flow.begin[a + 1]; ++k)
      inwards += flow.pairs[k].conductance * (p.position[flow.pairs[k].to] - p.position[a]);
    for (auto k = flow.face_begin[a]; k < flow.face_begin[a + 1]; ++k)
      inwards += flow.face_pairs[k].conductance * flow.face_pairs[k].x;
    free_.outlet[a] = inwards.norm() / (std::sqrt(p.volume(a) / p.fill[a]) / 2);
  }
}

void WaterStencils::visit(StateArchive& state, const Particles& p) {
  if (pores_.follows()) pores_.visit(state);
  bool moved = has_moved();
  state.value("dynamic_moved", moved);
  if (!moved) return;
  made_at_.resize(p.size()), density_then_.resize(p.size());
  state.array("dynamic_position", made_at_);
  state.array("dynamic_density", density_then_);
  if (!state.restoring()) return;
  Particles then = p;
  then.position = made_at_, then.density = density_then_;
  make(then);
}

}  // namespace porosph
