#include "solver/output/strain.hpp"

#include <limits>

#include "solver/sph/kernel/cubic_spline.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {
namespace {

struct Moved {
  std::span<const Vec2> start, position;
  std::span<const double> volume;
};

/// F of particle a, from the differences to its neighbours.
Mat2 deformation(const Moved& p, std::size_t a, std::span<const std::int32_t> near,
                 const CubicSpline<2>& kernel) {
  Mat2 before = Mat2::Zero(), after = Mat2::Zero();
  for (const std::int32_t b : near) {
    const Vec2 difference = p.start[b] - p.start[a];
    const Vec2 gradient = -p.volume[b] * kernel.slope(difference.norm()) * difference;
    before += difference * gradient.transpose();
    after += (p.position[b] - p.position[a]) * gradient.transpose();
  }
  constexpr double spans_the_plane = 1e-2;  // det of `before` is 1 inside, about 1/4 in a right-angled corner
  if (!(before.determinant() > spans_the_plane))
    return Mat2::Constant(std::numeric_limits<double>::quiet_NaN());
  return after * inverse(before);
}

}  // namespace

std::vector<Strain> strain_between(std::span<const Vec2> start, std::span<const Vec2> position,
                                   std::span<const double> volume, double smoothing_length) {
  const CubicSpline<2> kernel(smoothing_length);
  const NeighbourList neighbours = find_neighbours(start, start.size(), kernel.support());
  const Moved moved{start, position, volume};
  std::vector<Strain> strain(start.size());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < start.size(); ++a) {
    const Mat2 f = deformation(moved, a, neighbours.of(a), kernel);
    const Mat2 e = 0.5 * (f.transpose() * f - Mat2::Identity());
    strain[a] = {e(0, 0), e(1, 1), 0, e(0, 1)};
  }
  return strain;
}

std::vector<Strain> strain_since_start(const Model& model) {
  const Particles& p = model.particles;
  std::vector<double> volumes(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) volumes[i] = p.volume(i);
  return strain_between(p.start, p.position, volumes, model.smoothing_length);
}

}  // namespace porosph
