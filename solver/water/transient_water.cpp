#include "solver/water/transient_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/case/pores.hpp"
#include "solver/water/flow/steady_seepage.hpp"

namespace porosph {
namespace {

constexpr double first_share = 0.01;  // of a particle's pores that the first step may fill
constexpr double least_share = 1e-4;  // of the first step: the shortest one

std::vector<Pores> pores_of(const Case& scene, const Particles& p) {
  std::vector<Pores> pores;
  for (const std::int32_t s : p.soil) {
    const SoilCase& soil = scene.soils[s];
    const double porosity = porosity_of(soil);
    pores.push_back({.free = porosity - soil.retention.residual,
                     .elastic = porosity * scene.water.unit_weight / scene.water.coupling.bulk_modulus});
  }
  return pores;
}

}  // namespace

TransientWater::TransientWater(const Case& scene, const Particles& p, const Vec2& origin)
    : FlowingWater(scene, p, origin),
      soils_(scene.soils),
      gravity_(scene.loading.gravity),
      richards_(flow_, pores_of(scene, p), face_of_patch(), named_faces(), start(scene, p), settings(scene)) {
  tell();
  for (std::size_t a = 0; a < p.size(); ++a)
    start_density_.push_back(unit_weight(soils_[p.soil[a]], a, p.volume(a), p.position[a]) / gravity_);
}

Richards::Start TransientWater::start(const Case& scene, const Particles& p) const {
  const TransientCase& c = scene.water.transient;
  FaceConditions faces(outline_, faces_);
  std::vector<double> height;
  for (const Vec2& x : p.position) height.push_back(x.y());
  const bool level = c.start_level < never, given = c.start_pressure_head < never;
  if (!level && !given) {
    if (const std::int32_t a = flow_.unreached(faces); a >= 0)
      throw std::runtime_error(
          fmt::format("steady seepage at the start: the soil around {} is reached by no [[water.face]] of "
                      "kind \"head\", \"seepage\" or \"rain\"; water.start_level gives it water at rest",
                      place(a)));
    std::vector<HydraulicFaceCase> at_start;
    for (const HydraulicFaceCase& face : faces_) at_start.push_back(face_now(face, 0));
    SteadySeepage found = solve_steady(flow_, faces, start_of_steady(at_start, height));
    return {std::move(found.head), std::move(found.faces)};
  }
  std::vector<double> head;
  for (const double y : height)
    head.push_back(std::max(level ? c.start_level : -never, given ? y + c.start_pressure_head : -never));
  FaceSwitch(flow_, faces.size(), 1).update(head, faces);
  return {std::move(head), std::move(faces)};
}

/// The first step: what a flow at the largest permeability takes to fill a small part of a particle's pores.
Richards::Settings TransientWater::settings(const Case& scene) const {
  const CouplingCase& c = scene.water.coupling;
  double fastest = 0;
  for (const SoilCase& soil : scene.soils) fastest = std::max(fastest, soil.permeability.maxCoeff());
  const double usual = first_share * usual_porosity * scene.particles.spacing / fastest;
  const double first = c.first_step > 0 ? c.first_step : usual;
  return {.first_step = first,
          .least_step = least_share * std::min(first, usual),
          .growth = c.growth,
          .tolerance = c.tolerance};
}

double TransientWater::advance(double now, double until) {
  try {
    return richards_.advance(now, until);
  } catch (const Richards::NotConverged& stuck) {
    throw std::runtime_error(fmt::format(
        "seepage over time does not converge at {:.6g} s around {}, in steps down to {:.2g} s; "
        "the usual causes are retention that changes much within one spacing, and faces whose level or rate "
        "jumps",
        stuck.time, place(stuck.particle), stuck.step));
  }
}

void TransientWater::tell() {
  const auto head = richards_.head();
  record_.through_faces = through_faces(head, richards_.faces());
  record_.newton_steps = static_cast<int>(richards_.counts().newton_steps);
  record_.krylov_iterations = static_cast<int>(richards_.counts().krylov_iterations);
  record_.imbalance = richards_.balance().error();
  FlowingWater::tell({head.begin(), head.end()}, richards_.faces());
}

void TransientWater::add_weight(const Particles& p, const Vec2& gravity,
                                std::span<Vec2> accelerations) const {
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double now = unit_weight(soils_[p.soil[a]], a, p.volume(a), p.position[a]) / gravity_;
    accelerations[a] += (now / start_density_[a] - 1) * gravity;
  }
}

void TransientWater::visit(StateArchive& state) {
  richards_.visit(state);
  state.array("flow_told_head", record_.head);
  state.array("flow_told_velocity", record_.velocity);
  state.array("flow_told_gradient", record_.gradient);
  state.array("flow_told_saturation", record_.saturation);
  state.array("flow_told_through_faces", record_.through_faces);
  state.array("flow_told_through_sections", record_.through_sections);
  visit_taken_along(state);
}

}  // namespace porosph
