#include "solver/sph/consistent/rows_at_walls.hpp"

#include <algorithm>

#include "solver/sph/correction/kernel_correction.hpp"

namespace porosph {
namespace {

/// L of eq. (10) by the soil alone.
Mat2 correction_by_soil(const ReferenceConfiguration& r, std::int32_t a) {
  Mat2 sum = Mat2::Zero();
  r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
    if (is_soil(r, b)) sum += Vec2(g.x, g.y) * (r.points[b] - r.points[a]).transpose();
  });
  return correction_matrix(sum);
}

}  // namespace

void RowsAtWalls::find(const ReferenceConfiguration& r, const Model& model) {
  const auto n = static_cast<std::int32_t>(r.particles());
  correction_.resize(n);
  neighbours_.assign(n, 0), in_soil_.assign(n, 0), sees_ghosts_.assign(n, 0), sees_fixed_.assign(n, 0);
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    if (r.stencils.last_neighbour(a) < n) {  // ghosts would come last
      neighbours_[a] = in_soil_[a] = r.stencils.count_of_neighbours(a);
      correction_[a] = r.correction[a];
      continue;
    }
    sees_ghosts_[a] = 1;
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry&) {
      const bool fixed = is_fixed_image(r, b);
      sees_fixed_[a] |= fixed;
      if (!fixed) ++neighbours_[a];
      if (is_soil(r, b)) ++in_soil_[a];
    });
    correction_[a] = correction_by_soil(r, a);
  }
  particles_.clear();
  for (std::int32_t a = 0; a < n; ++a)
    if (sees_fixed_[a] && model.soils[model.particles.soil[a]].flows()) particles_.push_back(a);
}

void RowsAtWalls::blind(const LooseParticles& loose) {
  blind_.assign(neighbours_.size(), 0);
  for (std::size_t a = 0; a < blind_.size(); ++a)
    blind_[a] = sees_fixed_[a] && (in_soil_[a] >= LooseParticles::fewest_neighbours || loose.is(a));
}

RowsAtWalls::Gradients RowsAtWalls::gradients(const ReferenceConfiguration& r, std::span<const Vec2> v,
                                              std::int32_t a) const {
  const auto n = static_cast<std::int32_t>(r.particles());
  Mat2 soil = Mat2::Zero(), walls = Mat2::Zero();
  r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
    const Eigen::RowVector2d way(g.x, g.y);
    const Vec2 other =
        b < n ? v[b] : r.ghosts.from_root<Mirrors::motion>(b - n, Vec2(v[r.ghosts.root(b - n)]));
    (is_soil(r, b) ? soil : walls) += (other - v[a]) * way;
  });
  return {soil * correction_[a].transpose(), (soil + walls) * r.correction[a].transpose()};
}

void RowsAtWalls::take_velocities(const ReferenceConfiguration& r, const Particles& p) {
  gradient_.resize(particles_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < particles_.size(); ++k) gradient_[k] = gradients(r, p.velocity, particles_[k]);
}

double RowsAtWalls::deform(double dt, const LooseParticles& loose, PlaneTensors& deformation) const {
  double largest = 0;
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    const std::int32_t a = particles_[k];
    if (loose.is(a)) continue;
    const Mat2 f = deformation[a] + dt * gradient_[k].own;
    deformation.set(a, f);
    largest = std::max(largest, (f - Mat2::Identity()).cwiseAbs().maxCoeff());
  }
  return largest;
}

void RowsAtWalls::leave_out(const ReferenceConfiguration& r, std::span<const double> viscosity,
                            PlaneTensors& flux, std::span<Record> records) const {
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    const std::int32_t a = particles_[k];
    if (!blind_[a]) continue;
    flux.set(a, flux[a] + viscosity[a] * (gradient_[k].with_walls - gradient_[k].own));
    if (!r.listed[a]) continue;
    for (int i = 0; i < 4; ++i) records[a].q[i] = flux.component[i][a];
  }
}

void RowsAtWalls::leave_out(const ReferenceConfiguration& r, const Particles& p,
                            std::span<const double> viscosity, std::span<Vec2> accelerations) const {
  const auto n = static_cast<std::int32_t>(r.particles());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    const std::int32_t a = particles_[k];
    // The kernels have summed this particle's half of each pair; the image's own half is left out there.
    const Mat2& gradient = blind_[a] ? gradient_[k].own : gradient_[k].with_walls;
    Vec2 half = Vec2::Zero();
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      if (b < n || !is_fixed_image(r, b)) return;
      const Vec2 v = r.ghosts.from_root<Mirrors::motion>(b - n, Vec2(p.velocity[r.ghosts.root(b - n)]));
      half += g.w * (v - p.velocity[a]) - gradient * Vec2(g.x, g.y);
    });
    accelerations[a] += (blind_[a] ? -1 : 1) * viscosity[a] / (p.fill[a] * r.density[a]) * half;
  }
}

}  // namespace porosph
