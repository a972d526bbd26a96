// Compiled once for each kind of vector units, into a namespace of that name. Everything that it calls must
// be inlined: a function shared with other files could be linked in from here and be too wide for a
// processor.
#include <algorithm>

#include "solver/sph/kernels/pair_weights.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

template <int dim>
inline void weigh_some(const WeighedPoints<dim>& all, const CubicSpline<dim>& kernel, const double* here,
                       const std::int32_t* neighbours, std::int64_t count, double* w) {
#pragma omp simd
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t b = neighbours[k];
    double squared = 0;
    for (int d = 0; d < dim; ++d) {
      const double way = all.points[dim * b + d] - here[d];
      squared += way * way;
    }
    w[k] = -all.volumes[b] * kernel.slope(std::sqrt(squared));
  }
}

/// In whole vectors, the last of which may overlap the one before.
template <int dim>
void weigh(const WeighedPoints<dim>& all, std::int32_t a, const std::int32_t* neighbours, std::int64_t count,
           double* w) {
  constexpr std::int64_t lanes = 8;
  const CubicSpline<dim> kernel = all.kernel;
  const double* here = all.points + dim * static_cast<std::int64_t>(a);
  if (count < lanes) return weigh_some(all, kernel, here, neighbours, count, w);
  for (std::int64_t k = 0; k < count; k += lanes) {
    const std::int64_t first = std::min(k, count - lanes);
    weigh_some(all, kernel, here, neighbours + first, lanes, w + first);
  }
}

}  // namespace

extern const PairWeights<2> pair_weights_in_plane;
extern const PairWeights<3> pair_weights_in_solid;
const PairWeights<2> pair_weights_in_plane = weigh<2>;
const PairWeights<3> pair_weights_in_solid = weigh<3>;

}  // namespace porosph::POROSPH_VECTOR_UNITS
