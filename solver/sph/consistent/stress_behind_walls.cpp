#include "solver/sph/consistent/stress_behind_walls.hpp"

#include "solver/sph/correction/kernel_correction.hpp"

namespace porosph {

StressBehindWalls::StressBehindWalls(const ReferenceConfiguration& r, std::span<const Wall> walls) {
  const Ghosts& ghosts = r.ghosts;
  while (extrapolated_ < ghosts.size() && walls[ghosts.image(extrapolated_).wall].bears_weight)
    ++extrapolated_;
  std::vector<std::uint8_t> from_extrapolated(ghosts.size());
  for (std::size_t i = 0; i < ghosts.size(); ++i)
    from_extrapolated[i] = i < extrapolated_ || (ghosts.stems_from_ghost(i) &&
                                                 from_extrapolated[ghosts.parent(i) - ghosts.particles()]);
  std::vector<std::int32_t> place(ghosts.particles(), -1);
  for (std::size_t i = 0; i < extrapolated_; ++i) {
    const std::int32_t a = ghosts.root(i);
    if (place[a] < 0) {
      place[a] = static_cast<std::int32_t>(stencils_.size());
      stencils_.push_back(one_sided(r, a, from_extrapolated));
    }
    stencil_of_.push_back(place[a]);
  }
  gradients_.resize(stencils_.size());
}

StressBehindWalls::OneSided StressBehindWalls::one_sided(
    const ReferenceConfiguration& r, std::int32_t a,
    const std::vector<std::uint8_t>& from_extrapolated) const {
  const auto n = static_cast<std::int32_t>(r.particles());
  OneSided stencil{.particle = a, .neighbours = {}, .gradient = {}};
  Mat2 sum = Mat2::Zero();
  r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& pair) {
    if (b >= n && from_extrapolated[b - n]) return;
    const Vec2 g(pair.x, pair.y);
    stencil.neighbours.push_back(b);
    stencil.gradient.push_back(g);
    sum += g * (r.points[b] - r.points[a]).transpose();
  });
  const Mat2 correction = correction_matrix(sum, 0.01);  // it extrapolates, no force is as stiff as it
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

void StressBehindWalls::fill(const ReferenceConfiguration& r, std::vector<PlaneTensor>& piola) {
  const Ghosts& ghosts = r.ghosts;
  const std::size_t n = ghosts.particles();
  const auto mirror = [&](std::size_t i) {
    piola[n + i] = plane_tensor(ghosts.mirrored<Mirrors::tensor>(i, matrix(piola[ghosts.parent(i)])));
  };
  ghosts.for_each(mirror, extrapolated_);
  sum_gradients(piola);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < extrapolated_; ++i) piola[n + i] = plane_tensor(extrapolated(r, i, piola));
  for (const std::size_t i : ghosts.of_ghosts())  // those mirror what was extrapolated
    if (i >= extrapolated_) mirror(i);
}

void StressBehindWalls::sum_gradients(const std::vector<PlaneTensor>& piola) {
#pragma omp parallel for schedule(static)
  for (std::size_t s = 0; s < stencils_.size(); ++s) {
    const OneSided& stencil = stencils_[s];
    const Mat2 own = matrix(piola[stencil.particle]);
    Mat2 along_x = Mat2::Zero(), along_y = Mat2::Zero();
    for (std::size_t k = 0; k < stencil.neighbours.size(); ++k) {
      const Mat2 difference = matrix(piola[stencil.neighbours[k]]) - own;
      along_x += difference * stencil.gradient[k].x();
      along_y += difference * stencil.gradient[k].y();
    }
    gradients_[s] = {along_x, along_y};
  }
}

Mat2 StressBehindWalls::extrapolated(const ReferenceConfiguration& r, std::size_t i,
                                     const std::vector<PlaneTensor>& piola) const {
  const auto& [along_x, along_y] = gradients_[stencil_of_[i]];
  const std::int32_t a = r.ghosts.root(i);
  const Mat2 root = matrix(piola[a]);
  const Vec2 way = r.points[r.ghosts.particles() + i] - r.points[a];
  const Mat2 stress = root + along_x * way.x() + along_y * way.y();
  const Wall& wall = r.ghosts.wall(i);
  if (wall.support().carries_shear()) return stress;
  const Mat2 across = wall.normal * wall.normal.transpose(), along = Mat2::Identity() - across;
  const Mat2 mirrored = r.ghosts.mirrored<Mirrors::tensor>(i, root);
  return across * stress * across + along * stress * along + across * mirrored * along +
         along * mirrored * across;
}

}  // namespace porosph
