#include "solver/sph/consistent/surroundings.hpp"

#include <algorithm>
#include <utility>

#include "solver/sph/consistent/body_contact.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"

namespace porosph {
namespace {

constexpr double margin = 0.2;  // spacings by which strangers are nearer than the support

Ghosts ghosts_behind_walls(const Model& model, double range, std::vector<Vec2>& points) {
  const std::size_t n = points.size();
  if (model.visibility.everywhere()) return {model.walls, 0, model.walls.size(), range, points};
  return {model.walls, model.visibility.walls().append_seen_images(points), n};
}

NeighbourList only_seen(const Model& model, const SeenNeighbours& all) {
  const Particles& p = model.particles;
  const auto n = static_cast<std::int32_t>(p.size());
  const WallPaths& walls = model.visibility.walls();
  const std::vector<Vec2>& points = all.points;
  std::vector<std::vector<std::int32_t>> near(n);
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) near[a] = walls.near(points[a]);
  return kept(all.list, [&](std::int32_t a, std::int32_t b) {
    if (b < n) return walls.clear(points[a], points[b], near[a]) && model.visibility.past_slits(a, b, p);
    const std::size_t ghost = b - n;
    return walls.leads(points[a], points[b], ghost, all.ghosts.images(), n, near[a]) &&
           model.visibility.past_slits(a, all.ghosts.root(ghost), p);
  });
}

/// The ghosts of particle a: ordered[first[a]] to ordered[first[a + 1] - 1], numbered after the particles.
struct GhostsOfParticles {
  GhostsOfParticles(const Ghosts& ghosts, std::size_t particles)
      : first(particles + 1), ordered(ghosts.size()) {
    for (std::size_t i = 0; i < ghosts.size(); ++i) ++first[ghosts.root(i) + 1];
    for (std::size_t a = 0; a < particles; ++a) first[a + 1] += first[a];
    std::vector<std::int32_t> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < ghosts.size(); ++i)
      ordered[next[ghosts.root(i)]++] = static_cast<std::int32_t>(particles + i);
  }
  std::vector<std::int32_t> first, ordered;
};

}  // namespace

Surroundings::Surroundings(const Model& model)
    : support_(CubicSpline<2>(model.smoothing_length).support()),
      reach_(stencil_reach(CubicSpline<2>(model.smoothing_length))),
      skin_(model.spacing),
      body_(bodies_of_soils(model, support_)) {}

SeenNeighbours Surroundings::find(const Model& model) {
  // Most bodies are asked once: a skin would cost them more than it saves.
  if (!std::exchange(asked_before_, true) || !model.visibility.everywhere()) return found_by_search(model);
  if (!candidates_hold(model)) look_for_candidates(model);
  SeenNeighbours seen{.points = model.particles.position, .ghosts = {}, .list = {}};
  seen.ghosts = ghosts_behind_walls(model, support_, seen.points);
  seen.list = near_candidates(seen, model.particles);
  return seen;
}

SeenNeighbours Surroundings::found_by_search(const Model& model) {
  SeenNeighbours seen{.points = model.particles.position, .ghosts = {}, .list = {}};
  seen.ghosts = ghosts_behind_walls(model, support_, seen.points);
  seen.list = find_neighbours(seen.points, model.particles.size(), reach_);
  ++searches_;
  if (!model.visibility.everywhere()) seen.list = only_seen(model, seen);
  if (body_.empty()) return seen;
  const auto n = static_cast<std::int32_t>(model.particles.size());
  seen.list = kept(seen.list, [&](std::int32_t a, std::int32_t b) {
    return of_one_body(a, b < n ? b : seen.ghosts.root(b - n), model.particles);
  });
  return seen;
}

bool Surroundings::candidates_hold(const Model& model) const {
  const std::vector<Vec2>& now = model.particles.position;
  if (searched_at_.size() != now.size()) return false;
  double farthest = 0;
#pragma omp parallel for schedule(static) reduction(max : farthest)
  for (std::size_t a = 0; a < now.size(); ++a)
    farthest = std::max(farthest, (now[a] - searched_at_[a]).squaredNorm());
  return farthest < 0.25 * skin_ * skin_;
}

void Surroundings::look_for_candidates(const Model& model) {
  searched_at_ = model.particles.position;
  ++searches_;
  search_where_they_were(model);
}

/// Each ghost moves as far as the particle that it stems from, so particles stand for their ghosts as well.
void Surroundings::search_where_they_were(const Model& model) {
  std::vector<Vec2> points = searched_at_;
  std::vector<Image> images;
  append_images(model.walls, 0, model.walls.size(), support_ + skin_, points, images, skin_);
  const std::size_t n = searched_at_.size();
  const std::vector<std::int32_t> root = roots(images, n);
  const NeighbourList all = find_neighbours(points, n, support_ + skin_);
  candidates_ = collected(n, [&](std::size_t a, std::vector<std::int32_t>& list) {
    const auto first = std::ssize(list);
    const auto of = all.of(a);
    for (const std::int32_t b : of) list.push_back(static_cast<std::size_t>(b) < n ? b : root[b - n]);
    if (of.empty() || static_cast<std::size_t>(of.back()) < n) return;
    std::sort(list.begin() + first, list.end());
    list.erase(std::unique(list.begin() + first, list.end()), list.end());
  });
  strangers_.clear();
  for (std::int32_t a = 0; !body_.empty() && a < static_cast<std::int32_t>(n); ++a)
    for (const std::int32_t b : candidates_.of(a))
      if (b > a && !of_one_body(a, b, model.particles)) strangers_.push_back({a, b});
}

const std::vector<std::pair<std::int32_t, std::int32_t>>& Surroundings::strangers(const Model& model) {
  if (!body_.empty() && !candidates_hold(model)) look_for_candidates(model);
  return strangers_;
}

/// So that a run that is resumed searches as often as one that was not interrupted.
void Surroundings::visit(StateArchive& state, const Model& model) {
  bool have_candidates = !searched_at_.empty();
  state.value("asked_before", asked_before_);
  state.value("searches", searches_);
  state.value("have_candidates", have_candidates);
  if (!have_candidates) {
    searched_at_.clear();
    return;
  }
  searched_at_.resize(model.particles.size());
  state.array("searched_at", searched_at_);
  if (state.restoring()) search_where_they_were(model);
}

/// As find_neighbours has them, to the order.
NeighbourList Surroundings::near_candidates(const SeenNeighbours& seen, const Particles& p) const {
  const std::size_t n = p.size();
  const GhostsOfParticles ghosts(seen.ghosts, n);
  const std::vector<Vec2>& points = seen.points;
  return collected(n, [&](std::size_t a, std::vector<std::int32_t>& list) {
    const Vec2 here = points[a];
    const auto is_near = [&](std::int32_t b) { return (points[b] - here).squaredNorm() < reach_ * reach_; };
    const auto candidates = candidates_.of(a);
    std::size_t end = list.size();
    list.resize(end + candidates.size());
    unsigned behind_walls = 0;
    for (const std::int32_t b : candidates) {
      if (!of_one_body(static_cast<std::int32_t>(a), b, p)) continue;
      behind_walls |= ghosts.first[b] < ghosts.first[b + 1];
      list[end] = b;
      end += is_near(b) & (static_cast<std::size_t>(b) != a);
    }
    list.resize(end);
    if (!behind_walls) return;
    const auto first = std::ssize(list);
    for (const std::int32_t b : candidates_.of(a))
      for (std::int32_t k = ghosts.first[b]; k < ghosts.first[b + 1]; ++k)
        if (is_near(ghosts.ordered[k]) && of_one_body(static_cast<std::int32_t>(a), b, p))
          list.push_back(ghosts.ordered[k]);
    std::sort(list.begin() + first, list.end());
  });
}

/// The neighbours were all within the support of each other at the points, so one of two strangers has moved.
bool Surroundings::strangers_are_near(const Model& model, const PairStencils& stencils,
                                      std::span<const Vec2> points) {
  const Particles& p = model.particles;
  const auto n = static_cast<std::int32_t>(p.size());
  const double near = support_ - margin * model.spacing, moved = 0.5 * margin * model.spacing;
  if (!candidates_hold(model)) look_for_candidates(model);
  bool found = false;
#pragma omp parallel reduction(|| : found)
  {
    std::vector<std::int32_t> known_to(n, -1);  // the last particle in turn that has it as a neighbour
#pragma omp for schedule(static)
    for (std::int32_t a = 0; a < n; ++a) {
      if (found || (p.position[a] - points[a]).squaredNorm() < moved * moved) continue;
      stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry&) {
        if (b < n) known_to[b] = a;
      });
      for (const std::int32_t b : candidates_.of(a))
        found = found ||
                (b != a && known_to[b] != a && (p.position[b] - p.position[a]).squaredNorm() < near * near &&
                 of_one_body(a, b, p) && model.visibility.sees(a, b, p));
    }
  }
  return found;
}

}  // namespace porosph
