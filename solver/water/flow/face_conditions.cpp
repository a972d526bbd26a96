#include "solver/water/flow/face_conditions.hpp"

#include <algorithm>
#include <cmath>

namespace porosph {
namespace {

/// Linear between the points, constant before and after.
double value_at(const std::vector<Vec2>& points, double time) {
  const auto next = std::ranges::find_if(points, [time](const Vec2& p) { return p.x() > time; });
  if (next == points.begin()) return next->y();
  const Vec2 before = *(next - 1);
  if (next == points.end()) return before.y();
  return before.y() + (next->y() - before.y()) * (time - before.x()) / (next->x() - before.x());
}

}  // namespace

HydraulicFaceCase face_now(HydraulicFaceCase face, double time) {
  if (!face.level_over_time.empty()) face.level = value_at(face.level_over_time, time);
  if (!face.rate_over_time.empty()) face.rate = value_at(face.rate_over_time, time);
  return face;
}

FaceConditions::FaceConditions(const HydraulicOutline& outline, const std::vector<HydraulicFaceCase>& faces,
                               bool submerged)
    : submerged_(submerged), state_(outline.patches.size(), PatchState::wet) {
  if (std::ranges::any_of(faces, &HydraulicFaceCase::changes)) changing_ = faces;
  for (const HydraulicPatch& patch : outline.patches) {
    Condition c;
    c.height = outline.middle(patch).y();
    c.face = patch.face;
    if (patch.face >= 0) {
      const HydraulicFaceCase face = face_now(faces[patch.face], 0);
      const bool rains = face.kind == FaceKind::rain;
      c.kind = face.kind;
      c.limited = rains || face.kind == FaceKind::seepage || face.kind == FaceKind::head;
      c.level = face.level;
      if (rains) c.plan = std::abs(outline.stretches[patch.stretch].normal.y());
      if (rains) state_[of_patch_.size()] = PatchState::rate;
      if (rains || face.kind == FaceKind::flux) c.rate = face.rate * c.plan;
      if (rains) c.ponding = face.ponding, c.driest = face.driest;
    }
    of_patch_.push_back(c);
  }
}

void FaceConditions::set_time(double time) {
  if (changing_.empty()) return;
  std::vector<HydraulicFaceCase> now;
  for (const HydraulicFaceCase& face : changing_) now.push_back(face_now(face, time));
  for (Condition& c : of_patch_) {
    if (c.face < 0) continue;
    c.level = now[c.face].level;
    if (c.kind == FaceKind::flux || c.kind == FaceKind::rain) c.rate = now[c.face].rate * c.plan;
  }
}

}  // namespace porosph
