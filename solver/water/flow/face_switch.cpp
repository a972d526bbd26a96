#include "solver/water/flow/face_switch.hpp"

#include <cmath>
#include <map>

#include "solver/space/parallel.hpp"

namespace porosph {

bool FaceSwitch::set(std::int32_t patch, PatchState state, FaceConditions& faces) {
  if (faces.state(patch) == state) return false;
  if (flips_[patch] >= most_flips_ && state != PatchState::rate) return false;
  faces.set_state(patch, state);
  ++flips_[patch];
  return true;
}

bool FaceSwitch::update(std::span<const double> head, FaceConditions& faces,
                        std::span<const double> storing) {
  std::vector<double> through = flow_.through_patches(head, faces);
  const double tiny =
      1e-9 * deterministic_sum(through.size(), [&](std::size_t p) { return std::abs(through[p]); });
  if (!storing.empty()) {
    const std::vector<std::int32_t> pinned_by = flow_.pinning_patches(faces);
    for (std::size_t a = 0; a < pinned_by.size(); ++a)
      if (pinned_by[a] >= 0) through[pinned_by[a]] += storing[a];
  }
  const bool seepage = update_seepage(head, through, tiny, faces);
  return update_rain(head, through, tiny, faces) || seepage;
}

bool FaceSwitch::update_seepage(std::span<const double> head, std::span<const double> through, double tiny,
                                FaceConditions& faces) {
  const std::vector<double> pressure = flow_.pressure_heads_at_patches(head);
  bool changed = false;
  for (std::size_t p = 0; p < faces.size(); ++p) {
    const auto patch = static_cast<std::int32_t>(p);
    if (!faces.switches(patch) || faces.is_rain(patch)) continue;
    const bool open = faces.open(patch);
    if (open ? through[p] > tiny : pressure[p] > 0)
      changed |= set(patch, open ? PatchState::rate : PatchState::wet, faces);
  }
  return changed;
}

bool FaceSwitch::update_rain(std::span<const double> head, std::span<const double> through, double tiny,
                             FaceConditions& faces) {
  std::map<std::int32_t, Group> groups;  // by the particle
  for (std::size_t p = 0; p < faces.size(); ++p) {
    const auto patch = static_cast<std::int32_t>(p);
    if (!faces.is_rain(patch)) continue;
    Group& group = groups[flow_.fed_by(patch)];
    group.patches.push_back(patch);
    group.supply += faces.supply(patch) * flow_.patch_length(patch), group.through += through[p];
  }
  if (groups.empty()) return false;
  const std::vector<double> wet = flow_.through_patches_if(head, faces, PatchState::wet);
  const std::vector<double> dry = flow_.through_patches_if(head, faces, PatchState::dry);
  bool changed = false;
  for (auto& [a, group] : groups) {
    for (const std::int32_t p : group.patches) group.wet += wet[p], group.dry += dry[p];
    const std::int32_t first = group.patches.front(), holder = flow_.holder(first);
    const PatchState next = holder < 0 ? by_flow(group, faces.state(first), tiny)
                                       : by_pressure(head[holder] - flow_.height(holder), group, faces, tiny);
    for (const std::int32_t patch : group.patches) changed |= set(patch, next, faces);
  }
  return changed;
}

/// From what would enter at the limits.
PatchState FaceSwitch::by_flow(const Group& group, PatchState now, double tiny) const {
  const double wet = now == PatchState::wet ? group.through - 2 * tiny : group.wet;
  if (wet < group.supply - tiny) return PatchState::wet;
  const double dry = now == PatchState::dry ? group.through + 2 * tiny : group.dry;
  return group.supply < 0 && dry > group.supply + tiny ? PatchState::dry : PatchState::rate;
}

/// Where a particle lies on the outline, its pressure head psi is the face's [m].
PatchState FaceSwitch::by_pressure(double psi, const Group& group, const FaceConditions& faces,
                                   double tiny) const {
  const std::int32_t first = group.patches.front();
  const PatchState now = faces.state(first);
  if (now == PatchState::rate) {
    if (psi > faces.limit(first, PatchState::wet)) return PatchState::wet;
    return psi < faces.limit(first, PatchState::dry) ? PatchState::dry : PatchState::rate;
  }
  const bool enough =
      now == PatchState::wet ? group.through > group.supply + tiny : group.through < group.supply - tiny;
  return enough ? PatchState::rate : now;
}

}  // namespace porosph
