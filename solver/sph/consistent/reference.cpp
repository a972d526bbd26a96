#include "solver/sph/consistent/reference.hpp"

#include <algorithm>
#include <utility>

#include "solver/sph/consistent/closed_gradients.hpp"
#include "solver/sph/correction/kernel_correction.hpp"

namespace porosph {
namespace {

void make_volumes(const Particles& p, ReferenceConfiguration& r) {
  r.density = p.density;
  r.volume.resize(p.size());
  for (std::size_t a = 0; a < p.size(); ++a) r.volume[a] = p.volume(a) / p.fill[a];
  r.ghosts.fill<Mirrors::scalar>(r.volume);
}

/// L of eq. (10), of the particles.
std::vector<Mat2> corrections(const ReferenceConfiguration& r, bool corrected) {
  std::vector<Mat2> correction(r.particles(), Mat2::Identity());
  if (!corrected) return correction;
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < correction.size(); ++a) {
    Mat2 sum = Mat2::Zero();
    r.stencils.for_neighbours(static_cast<std::int32_t>(a), [&](std::int32_t b, const PairGeometry& g) {
      sum += Vec2(g.x, g.y) * (r.points[b] - r.points[a]).transpose();
    });
    correction[a] = correction_matrix(sum);
  }
  return correction;
}

/// Closes the gradients where disorder asks for it, which changes L as well.
void close(const Model& model, ReferenceConfiguration& r, std::vector<Mat2>& correction) {
  Closure closure = close_gradients({.stencils = r.stencils,
                                     .volumes = r.volume,
                                     .fill = model.particles.fill,
                                     .correction = correction,
                                     .ghosts = r.ghosts,
                                     .spacing = model.spacing});
  if (closure.kappa.empty()) return;
  r.kappa.resize(closure.kappa.size());
  for (std::size_t i = 0; i < closure.kappa.size(); ++i) r.kappa.set(i, closure.kappa[i]);
  correction = std::move(closure.correction);
}

}  // namespace

ReferenceView ReferenceConfiguration::view(const Particles& p) {
  ReferenceView v{};
  v.stencils = &stencils;
  correction.connect(v.correction);
  for (int k = 0; k < 2; ++k) v.kappa[k] = closed() ? kappa.component[k].data() : nullptr;
  v.density = density.data();
  v.fill = p.fill.data();
  return v;
}

ReferenceConfiguration make_reference(const Model& model, const FormulationCase& formulation,
                                      SeenNeighbours seen) {
  const CubicSpline<2> kernel(model.smoothing_length);
  ReferenceConfiguration r;
  r.points = std::move(seen.points), r.ghosts = std::move(seen.ghosts);
  make_volumes(model.particles, r);
  r.stencils =
      make_pair_stencils(r.points, std::move(seen.list), r.volume, kernel, formulation.single_precision);

  std::vector<Mat2> correction = corrections(r, formulation.kernel_correction);
  if (formulation.closed_gradients && formulation.kernel_correction) close(model, r, correction);
  r.correction.resize(r.points.size());
  for (std::size_t a = 0; a < r.particles(); ++a) r.correction.set(a, correction[a]);
  r.ghosts.fill<Mirrors::tensor>([&](std::size_t k) { return r.correction[k]; },
                                 [&](std::size_t k, const Mat2& l) { r.correction.set(k, l); });

  r.listed.assign(r.points.size(), 0);
  for (const std::int32_t b : r.stencils.index) r.listed[b] = 1;
  return r;
}

}  // namespace porosph
