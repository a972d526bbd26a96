#include "solver/water/flow/darcy_flow.hpp"

#include <algorithm>
#include <cmath>

namespace porosph {

DarcyFlow::DarcyFlow(FlowPairs pairs, const HydraulicOutline& outline, std::vector<Retention> retention,
                     std::span<const std::int32_t> soil, std::span<const double> height)
    : pairs_(std::move(pairs)),
      retention_(std::move(retention)),
      soil_(soil.begin(), soil.end()),
      height_(height.begin(), height.end()),
      fed_by_patch_(pairs_.beside_patch) {
  for (const HydraulicPatch& patch : outline.patches) patch_length_.push_back(patch.to - patch.from);
  make_pattern();
  find_holders();
}

/// Patches beside a particle that lies on the outline are held with it.
void DarcyFlow::find_holders() {
  std::vector<std::uint8_t> on_face(particles(), 0);
  for (const std::int32_t a : pairs_.on_face) on_face[a] = 1;
  for (const std::int32_t a : fed_by_patch_) holder_.push_back(a >= 0 && on_face[a] ? a : -1);
}

void DarcyFlow::make_pattern() {
  slot_.resize(pairs_.pairs.size());
  face_slot_.resize(pairs_.face_pairs.size());
  for (std::size_t a = 0; a < particles(); ++a) {
    std::vector<std::int32_t> columns;
    for (auto k = pairs_.begin[a]; k < pairs_.begin[a + 1]; ++k) columns.push_back(pairs_.pairs[k].to);
    for (auto k = pairs_.face_begin[a]; k < pairs_.face_begin[a + 1]; ++k)
      if (pairs_.face_pairs[k].to != static_cast<std::int32_t>(a)) columns.push_back(pairs_.face_pairs[k].to);
    std::ranges::sort(columns);
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    const auto slot = [&](std::int32_t b) {
      if (b == static_cast<std::int32_t>(a)) return -1;
      return pattern_.begin.back() +
             static_cast<std::int32_t>(std::ranges::lower_bound(columns, b) - columns.begin());
    };
    for (auto k = pairs_.begin[a]; k < pairs_.begin[a + 1]; ++k) slot_[k] = slot(pairs_.pairs[k].to);
    for (auto k = pairs_.face_begin[a]; k < pairs_.face_begin[a + 1]; ++k)
      face_slot_[k] = slot(pairs_.face_pairs[k].to);
    pattern_.column.insert(pattern_.column.end(), columns.begin(), columns.end());
    pattern_.begin.push_back(static_cast<std::int32_t>(pattern_.column.size()));
  }
}

DarcyFlow::Image DarcyFlow::image(const FacePair& pair, const FaceConditions& faces) const {
  Image image{1, 0, false, pair.patch[0]};
  for (int i = 0; i < pair.images; ++i) {
    const auto head = faces.head(pair.patch[i], pair.crossing[i], pair.foot[i]);
    if (!head) continue;
    image = {-image.sign, 2 * *head - image.constant, true, pair.patch[i]};
    if (faces.is_dry(pair.patch[i]))
      image.dry_kr = retention(pair.from).permeability(faces.limit(pair.patch[i], PatchState::dry)).kr;
  }
  return image;
}

Retention::Permeability DarcyFlow::permeability(std::size_t a, double head) const {
  Retention::Permeability k = retention(a).permeability(head - height_[a]);
  k.kr *= ratio(a), k.slope *= ratio(a);
  return k;
}

std::vector<double> DarcyFlow::permeabilities(std::span<const double> head) const {
  std::vector<double> kr(particles());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < particles(); ++a) kr[a] = permeability(a, head[a]).kr;
  return kr;
}

void DarcyFlow::assemble(std::span<const double> head, const FaceConditions& faces, Slope kind,
                         SparseRows& slope, std::span<double> inflow) const {
  if (slope.begin != pattern_.begin || slope.column != pattern_.column) slope = pattern_;
  slope.value.assign(pattern_.column.size(), 0);
  slope.diagonal.assign(particles(), 0);
  std::vector<Retention::Permeability> kr(particles());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < particles(); ++a) {
    kr[a] = permeability(a, head[a]);
    if (kind == Slope::secant) kr[a].slope = 0;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < particles(); ++a) {
    double flow = 0, diagonal = 0;
    const auto within = [&](std::int32_t b, double conductance, std::int32_t slot) {
      const double fall = head[b] - head[a], of_a = share_of_first(fall), of_b = 1 - of_a;
      const double t = conductance * (of_a * kr[a].kr + of_b * kr[b].kr);
      flow += t * fall;
      diagonal += t - conductance * of_a * kr[a].slope * fall;
      slope.value[slot] -= t + conductance * of_b * kr[b].slope * fall;
    };
    for (auto k = pairs_.begin[a]; k < pairs_.begin[a + 1]; ++k)
      within(pairs_.pairs[k].to, pairs_.pairs[k].conductance, slot_[k]);
    for (auto k = pairs_.face_begin[a]; k < pairs_.face_begin[a + 1]; ++k) {
      const FacePair& pair = pairs_.face_pairs[k];
      const Image to = image(pair, faces);
      const std::int32_t slot = face_slot_[k];
      if (!to.fixed) {
        if (slot >= 0) within(pair.to, pair.conductance, slot);
        continue;
      }
      const double t = pair.conductance * through_kr(to, a, kr[a].kr);
      const double fall = to.sign * head[pair.to] + to.constant - head[a];
      flow += t * fall;
      diagonal += t - (to.dry_kr < 0 ? 0 : pair.conductance * kr[a].slope / 2 * fall);
      (slot >= 0 ? slope.value[slot] : diagonal) -= t * to.sign;
    }
    inflow[a] = flow, slope.diagonal[a] = diagonal;
  }
  for (std::size_t patch = 0; patch < fed_by_patch_.size(); ++patch)
    if (fed_by_patch_[patch] >= 0)
      inflow[fed_by_patch_[patch]] += faces.rate(static_cast<std::int32_t>(patch)) * patch_length_[patch];
  if (pairs_.on_face.empty()) return;
  const std::vector<std::int32_t> pinned_by = pinning_patches(faces);
  for (const std::int32_t a : pairs_.on_face) {
    if (pinned_by[a] < 0) continue;
    inflow[a] = 0, slope.diagonal[a] = 1;
    std::fill(slope.value.begin() + slope.begin[a], slope.value.begin() + slope.begin[a + 1], 0.0);
  }
  for (std::size_t k = 0; k < slope.column.size(); ++k)
    if (pinned_by[slope.column[k]] >= 0) slope.value[k] = 0;
}

void DarcyFlow::pin(std::span<double> head, const FaceConditions& faces) const {
  for (std::size_t k = 0; k < pairs_.on_face.size(); ++k) {
    const std::int32_t a = pairs_.on_face[k];
    if (const auto h = faces.head(pairs_.patch_of_on_face[k], height_[a], height_[a])) head[a] = *h;
  }
}

/// Calls use(flow into a, x of the pair or nothing, patch or -1) for each of its pairs.
template <class Use>
void DarcyFlow::for_flows(std::size_t a, std::span<const double> head, std::span<const double> kr,
                          const FaceConditions& faces, Use&& use) const {
  const auto within = [&](std::int32_t b, double conductance) {
    const double fall = head[b] - head[a], of_a = share_of_first(fall);
    return conductance * (of_a * kr[a] + (1 - of_a) * kr[b]) * fall;
  };
  for (auto k = pairs_.begin[a]; k < pairs_.begin[a + 1]; ++k)
    use(within(pairs_.pairs[k].to, pairs_.pairs[k].conductance), pairs_.pairs[k].to, nullptr, -1);
  for (auto k = pairs_.face_begin[a]; k < pairs_.face_begin[a + 1]; ++k) {
    const FacePair& pair = pairs_.face_pairs[k];
    const Image to = image(pair, faces);
    if (to.fixed)
      use(pair.conductance * through_kr(to, a, kr[a]) * (to.sign * head[pair.to] + to.constant - head[a]),
          pair.to, &pair.x, to.patch);
    else
      use(within(pair.to, pair.conductance), pair.to, &pair.x, -1);
  }
}

std::vector<double> DarcyFlow::through_patches(std::span<const double> head,
                                               const FaceConditions& faces) const {
  const std::vector<double> kr = permeabilities(head);
  std::vector<double> through(faces.size(), 0);
  const std::vector<std::int32_t> pinned_by = pinning_patches(faces);
  for (std::size_t a = 0; a < particles(); ++a) {
    if (pinned_by[a] >= 0) {
      through[pinned_by[a]] -= drawn_from(a, head, kr);
    } else if (pairs_.face_begin[a] < pairs_.face_begin[a + 1]) {
      for_flows(a, head, kr, faces, [&](double flow, std::int32_t, const Vec2*, std::int32_t patch) {
        if (patch >= 0) through[patch] += flow;
      });
    }
  }
  for (std::size_t patch = 0; patch < through.size(); ++patch) {
    const std::int32_t fed = fed_by_patch_[patch];
    if (fed < 0) continue;
    const double supplied = faces.rate(static_cast<std::int32_t>(patch)) * patch_length_[patch];
    through[patch] += supplied;
    if (pinned_by[fed] >= 0) through[pinned_by[fed]] -= supplied;  // what holds its head takes it
  }
  return through;
}

std::vector<std::int32_t> DarcyFlow::pinning_patches(const FaceConditions& faces) const {
  std::vector<std::int32_t> patch(particles(), -1);
  for (std::size_t k = 0; k < pairs_.on_face.size(); ++k) {
    const std::int32_t a = pairs_.on_face[k];
    if (faces.head(pairs_.patch_of_on_face[k], height_[a], height_[a])) patch[a] = pairs_.patch_of_on_face[k];
  }
  return patch;
}

/// What the others give to a particle on the outline: its cell is half of one, the other half is its mirror
/// image.
double DarcyFlow::drawn_from(std::size_t a, std::span<const double> head, std::span<const double> kr) const {
  double flow = 0;
  const auto add = [&](std::int32_t b, double conductance) {
    const double fall = head[b] - head[a], of_a = share_of_first(fall);
    flow += conductance * (of_a * kr[a] + (1 - of_a) * kr[b]) * fall;
  };
  for (auto k = pairs_.begin[a]; k < pairs_.begin[a + 1]; ++k)
    add(pairs_.pairs[k].to, pairs_.pairs[k].conductance);
  for (auto k = pairs_.face_begin[a]; k < pairs_.face_begin[a + 1]; ++k)
    add(pairs_.face_pairs[k].to, pairs_.face_pairs[k].conductance);
  return flow;
}

std::vector<double> DarcyFlow::pressure_heads_at_patches(std::span<const double> head) const {
  std::vector<double> sum(patch_length_.size(), 0), weight(patch_length_.size(), 0);
  const auto add = [&](std::int32_t patch, double psi, double w) {
    sum[patch] += w * psi, weight[patch] += w;
  };
  for (const FacePair& p : pairs_.face_pairs)
    if (p.images == 1) add(p.patch[0], (head[p.from] + head[p.to]) / 2 - p.crossing[0], p.conductance);
  for (std::size_t k = 0; k < pairs_.on_face.size(); ++k) {
    const std::int32_t a = pairs_.on_face[k];
    sum[pairs_.patch_of_on_face[k]] = head[a] - height_[a], weight[pairs_.patch_of_on_face[k]] = 1;
  }
  for (std::size_t patch = 0; patch < sum.size(); ++patch)
    sum[patch] = weight[patch] > 0 ? sum[patch] / weight[patch] : -never;
  return sum;
}

double DarcyFlow::between(std::int32_t a, std::int32_t b, double c, std::span<const double> head) const {
  const double fall = head[b] - head[a], of_a = share_of_first(fall);
  const double kr_a = permeability(a, head[a]).kr, kr_b = permeability(b, head[b]).kr;
  return c * (of_a * kr_a + (1 - of_a) * kr_b) * fall;
}

std::vector<double> DarcyFlow::through_patches_if(std::span<const double> head, const FaceConditions& faces,
                                                  PatchState state) const {
  std::vector<double> through(faces.size(), 0);
  for (const FacePair& p : pairs_.face_pairs) {
    if (p.images > 1 || !faces.switches(p.patch[0])) continue;
    const double psi = faces.limit(p.patch[0], state);
    Image to{-1, 2 * (p.foot[0] + psi), true, p.patch[0]};
    const Retention& soil = retention(p.from);
    if (state == PatchState::dry) to.dry_kr = soil.permeability(psi).kr;
    const double kr = permeability(p.from, head[p.from]).kr;
    through[p.patch[0]] +=
        p.conductance * through_kr(to, p.from, kr) * (to.constant - head[p.to] - head[p.from]);
  }
  return through;
}

std::vector<Vec2> DarcyFlow::velocities(std::span<const double> head, const FaceConditions& faces,
                                        std::span<const Vec2> position, bool saturated) const {
  std::vector<double> kr;
  if (!saturated) kr = permeabilities(head);
  for (std::size_t a = 0; saturated && a < particles(); ++a) kr.push_back(ratio(a));
  std::vector<Vec2> w(particles(), Vec2::Zero());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < particles(); ++a) {
    for_flows(a, head, kr, faces, [&](double flow, std::int32_t to, const Vec2* x, std::int32_t) {
      w[a] -= flow * (x != nullptr ? *x : Vec2(position[to] - position[a]));
    });
    w[a] = pairs_.correction[a] * w[a] / (2 * pairs_.volume[a]);
  }
  return w;
}

std::int32_t DarcyFlow::unreached(const FaceConditions& faces) const {
  std::vector<std::uint8_t> reached(particles(), 0);
  std::vector<std::int32_t> front;
  const auto reach = [&](std::int32_t a) {
    if (!reached[a]) reached[a] = 1, front.push_back(a);
  };
  for (const FacePair& p : pairs_.face_pairs)
    if (image(p, faces).fixed) reach(p.from);
  const std::vector<std::int32_t> pinned_by = pinning_patches(faces);
  for (std::size_t a = 0; a < particles(); ++a)
    if (pinned_by[a] >= 0) reach(static_cast<std::int32_t>(a));
  while (!front.empty()) {
    const std::int32_t a = front.back();
    front.pop_back();
    for (auto k = pairs_.begin[a]; k < pairs_.begin[a + 1]; ++k) reach(pairs_.pairs[k].to);
  }
  const auto found = std::ranges::find(reached, 0);
  return found == reached.end() ? -1 : static_cast<std::int32_t>(found - reached.begin());
}

}  // namespace porosph
