#include "solver/water/flow/drains.hpp"

#include <fmt/format.h>

#include <algorithm>
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

}  // namespace

void add_drains(const std::vector<DrainCase>& drains, const Particles& p, const Vec2& origin, double spacing,
                std::vector<HydraulicFaceCase>& faces, HydraulicOutline& outline, FlowPairs& pairs) {
  for (const DrainCase& drain : drains) {
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
      pairs.on_face.push_back(a);
      pairs.patch_of_on_face.push_back(static_cast<std::int32_t>(outline.patches.size()));
      pairs.beside_patch.push_back(a);
      outline.patches.push_back({.stretch = -1, .from = 0, .to = 0, .face = face, .place = p.position[a]});
    }
  }
}

}  // namespace porosph
