#include "solver/sph/consistent/stress_behind_walls.hpp"

#include <algorithm>

#include "solver/sph/correction/kernel_correction.hpp"

namespace porosph {

StressBehindWalls::StressBehindWalls(const ReferenceConfiguration& r, bool flows, const LooseParticles* loose)
    : flowed_(loose && loose->soil_has_flowed()) {
  // At rest no force is as stiff as what is extrapolated. The stress of a single row that slides over a wall
  // doubles in every step with a gradient across the row that its unevenness alone decides.
  const double spans_the_plane = flows ? 0.15 : 0.01;
  const Ghosts& ghosts = r.ghosts;
  const std::size_t n = ghosts.particles();
  std::vector<std::uint8_t> from_extrapolated(ghosts.size()), left_out(n + ghosts.size());
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    const bool extrapolates = ghosts.wall(i).bears_weight;
    (extrapolates ? extrapolated_ : mirrored_).push_back(i);
    from_extrapolated[i] =
        extrapolates || (ghosts.stems_from_ghost(i) && from_extrapolated[ghosts.parent(i) - n]);
    left_out[n + i] = from_extrapolated[i] || (loose && loose->is(ghosts.root(i)));
  }
  for (std::size_t a = 0; loose && a < n; ++a) left_out[a] = loose->is(a);
  std::vector<std::int32_t> place(n, -1);
  for (const std::size_t i : extrapolated_) {
    const std::int32_t a = ghosts.root(i);
    if (place[a] < 0) {
      place[a] = static_cast<std::int32_t>(stencils_.size());
      stencils_.push_back(one_sided(r, a, left_out, spans_the_plane));
    }
    continued_.push_back(continuation(r, i, place[a]));
  }
  gradients_.resize(stencils_.size());
}

/// Where the ghost lies in the soil's field, once what walls without weight mirrored is turned back.
StressBehindWalls::Continued StressBehindWalls::continuation(const ReferenceConfiguration& r,
                                                             std::size_t ghost, std::int32_t stencil) {
  const Ghosts& ghosts = r.ghosts;
  Continued c{.stencil = stencil};
  Vec2 place = r.points[ghosts.particles() + ghost];
  for (std::size_t i = ghost;; i = ghosts.parent(i) - ghosts.particles()) {
    if (!ghosts.wall(i).bears_weight) {
      place = ghosts.wall(i).mirrored(place);
      c.turn = c.turn * ghosts.reflection(i);
      c.turned = true;
    }
    if (!ghosts.stems_from_ghost(i)) break;
  }
  c.way = place - r.points[ghosts.root(ghost)];
  return c;
}

StressBehindWalls::OneSided StressBehindWalls::one_sided(const ReferenceConfiguration& r, std::int32_t a,
                                                         const std::vector<std::uint8_t>& left_out,
                                                         double spans_the_plane) {
  OneSided stencil{.particle = a, .neighbours = {}, .gradient = {}};
  if (left_out[a]) return stencil;
  Mat2 sum = Mat2::Zero();
  r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& pair) {
    if (left_out[b]) return;
    const Vec2 g(pair.x, pair.y);
    stencil.neighbours.push_back(b);
    stencil.gradient.push_back(g);
    sum += g * (r.points[b] - r.points[a]).transpose();
  });
  const Mat2 correction = correction_matrix(sum, spans_the_plane);
  stencil.determinant = sum.determinant();
  for (Vec2& g : stencil.gradient) g = correction * g;
  return stencil;
}

void StressBehindWalls::mark_used(const ReferenceConfiguration& r, std::vector<std::uint8_t>& used) const {
  const auto mark = [&](std::size_t b) {
    if (b < r.particles()) used[b] = 1;
  };
  for (std::size_t i = 0; i < r.ghosts.size(); ++i) mark(r.ghosts.parent(i));
  for (const OneSided& stencil : stencils_) {
    mark(stencil.particle);
    for (const std::int32_t b : stencil.neighbours) mark(b);
  }
}

void StressBehindWalls::fill(const ReferenceConfiguration& r, PlaneTensors& piola) {
  const Ghosts& ghosts = r.ghosts;
  const std::size_t n = ghosts.particles();
  const auto mirror = [&](std::size_t i) {
    piola.set(n + i, ghosts.mirrored<Mirrors::tensor>(i, piola[ghosts.parent(i)]));
  };
  for (const std::size_t i : mirrored_) mirror(i);
  sum_gradients(piola);
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < extrapolated_.size(); ++k)
    piola.set(n + extrapolated_[k], extrapolated(r, k, piola));
  for (const std::size_t i : mirrored_)  // those mirror what was extrapolated
    if (ghosts.stems_from_ghost(i)) mirror(i);
}

/// How far the gradient counts. In a toe of soil that has flowed it would be noise, and what walls do with it
/// sets the toe in motion for ever. The ghosts' stress is then mirrored as their motion is, so that walls
/// give no energy.
double StressBehindWalls::trust(const OneSided& stencil) const {
  constexpr double none = 0.3, full = 0.34;  // on a plane base, h = 1.2 dx: 0.34 in two rows, 0.39 in more
  return flowed_ ? std::clamp((stencil.determinant - none) / (full - none), 0.0, 1.0) : 1;
}

void StressBehindWalls::sum_gradients(const PlaneTensors& piola) {
#pragma omp parallel for schedule(static)
  for (std::size_t s = 0; s < stencils_.size(); ++s) {
    const OneSided& stencil = stencils_[s];
    const Mat2 own = piola[stencil.particle];
    Mat2 along_x = Mat2::Zero(), along_y = Mat2::Zero();
    for (std::size_t k = 0; k < stencil.neighbours.size(); ++k) {
      const Mat2 difference = piola[stencil.neighbours[k]] - own;
      along_x += difference * stencil.gradient[k].x();
      along_y += difference * stencil.gradient[k].y();
    }
    gradients_[s] = {along_x, along_y};
  }
}

Mat2 StressBehindWalls::extrapolated(const ReferenceConfiguration& r, std::size_t k,
                                     const PlaneTensors& piola) const {
  const std::size_t ghost = extrapolated_[k];
  const Continued& c = continued_[k];
  const double trusted = trust(stencils_[c.stencil]);
  if (trusted == 1) return continued(r, k, piola);
  const Mat2 mirrored = r.ghosts.flux_from_root(ghost, piola[r.ghosts.root(ghost)]);
  if (trusted == 0) return mirrored;
  return trusted * continued(r, k, piola) + (1 - trusted) * mirrored;
}

Mat2 StressBehindWalls::continued(const ReferenceConfiguration& r, std::size_t k,
                                  const PlaneTensors& piola) const {
  const std::size_t ghost = extrapolated_[k];
  const Continued& c = continued_[k];
  const auto& [along_x, along_y] = gradients_[c.stencil];
  Mat2 root = piola[r.ghosts.root(ghost)];
  Mat2 stress = root + along_x * c.way.x() + along_y * c.way.y();
  if (c.turned) root = c.turn * root * c.turn.transpose(), stress = c.turn * stress * c.turn.transpose();
  const Wall& wall = r.ghosts.wall(ghost);
  if (wall.support().carries_shear()) return stress;
  const Mat2 across = wall.normal * wall.normal.transpose(), along = Mat2::Identity() - across;
  const Mat2 mirrored = r.ghosts.mirrored<Mirrors::tensor>(ghost, root);
  return across * stress * across + along * stress * along + across * mirrored * along +
         along * mirrored * across;
}

}  // namespace porosph
