#include "solver/water/flow/drains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solver/space/place_text.hpp"

namespace porosph {
namespace {

double distance_to(const DrainCase& drain, const Vec2& place) {
  const Vec2 way = drain.to - drain.from;
  const double t =
      way.squaredNorm() > 0 ? std::clamp((place - drain.from).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0;
  return (drain.from + t * way - place).norm();
}

std::vector<std::int32_t> particles_of(const DrainCase& drain, const Particles& p, double spacing) {
  const bool is_line = drain.from != drain.to;
  std::vector<std::int32_t> near;
  double nearest = spacing;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double d = distance_to(drain, p.position[a]);
    if (is_line ? d > (0.5 + 1e-6) * spacing : d >= nearest) continue;
    if (!is_line) near.clear(), nearest = d * (1 - 1e-9);
    near.push_back(static_cast<std::int32_t>(a));
  }
  return near;
}

/// Of a ring of soil, per metre [m/s].
double conductance_around(double k, double outer, double inner) {
  return 2 * std::numbers::pi * k / std::log(outer / inner);
}

/// A pair of a particle with its own image behind the well's face, whose head h_w lies half way between: c
/// (2 h_w - 2 h) passes.
void add_to_well(std::int32_t a, double conductance, std::int32_t patch, double height, FlowPairs& pairs) {
  const auto end = pairs.face_begin.begin() + a + 1;
  pairs.face_pairs.insert(pairs.face_pairs.begin() + *end, {.from = a,
                                                            .to = a,
                                                            .conductance = conductance / 2,
                                                            .x = Vec2::Zero(),
                                                            .images = 1,
                                                            .patch = {patch, -1},
                                                            .crossing = {height, 0},
                                                            .foot = {height, 0}});
  for (auto next = end; next != pairs.face_begin.end(); ++next) ++*next;
}

}  // namespace

void add_drains(const Case& scene, const Particles& p, const Vec2& origin,
                std::vector<HydraulicFaceCase>& faces, HydraulicOutline& outline, FlowPairs& pairs) {
  const double spacing = scene.particles.spacing;
  for (const DrainCase& drain : scene.water.drains) {
    const std::vector<std::int32_t> near = particles_of(drain, p, spacing);
    if (near.empty())
      throw std::runtime_error(
          fmt::format("water.drain '{}' from {}: no particle of the soil is within a spacing of it",
                      drain.name, place_text(drain.from + origin)));
    const auto face = static_cast<int>(faces.size());
    const bool filled = drain.level < HydraulicFaceCase::unset;
    faces.push_back(
        {.kind = filled ? FaceKind::head : FaceKind::seepage, .level = drain.level, .name = drain.name});
    for (const std::int32_t a : near) {
      const auto patch = static_cast<std::int32_t>(outline.patches.size());
      if (drain.radius > 0) {
        const double k = scene.soils[p.soil[a]].permeability.x();
        add_to_well(a, conductance_around(k, DrainCase::own_radius * spacing, drain.radius), patch,
                    p.position[a].y(), pairs);
      } else {
        pairs.on_face.push_back(a), pairs.patch_of_on_face.push_back(patch);
      }
      pairs.beside_patch.push_back(a);
      outline.patches.push_back({.stretch = -1, .from = 0, .to = 0, .face = face, .place = p.position[a]});
    }
  }
}

}  // namespace porosph
