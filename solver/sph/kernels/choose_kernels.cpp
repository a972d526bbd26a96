// From vector units to the kernels compiled for them.
#include <tuple>

#include "solver/sph/kernels/consistent_kernels.hpp"
#include "solver/sph/kernels/pair_weights.hpp"
#include "solver/sph/kernels/paper_kernels.hpp"

namespace porosph {

#ifdef POROSPH_DISPATCH
namespace avx512 {
extern const ConsistentKernels consistent_kernels;
extern const PaperKernels paper_kernels;
extern const PairWeights<2> pair_weights_in_plane;
extern const PairWeights<3> pair_weights_in_solid;
}  // namespace avx512
namespace avx2 {
extern const ConsistentKernels consistent_kernels;
extern const PaperKernels paper_kernels;
extern const PairWeights<2> pair_weights_in_plane;
extern const PairWeights<3> pair_weights_in_solid;
}  // namespace avx2
#endif
namespace portable {
extern const ConsistentKernels consistent_kernels;
extern const PaperKernels paper_kernels;
extern const PairWeights<2> pair_weights_in_plane;
extern const PairWeights<3> pair_weights_in_solid;
}  // namespace portable

const ConsistentKernels& consistent_kernels([[maybe_unused]] VectorUnits units) {
#ifdef POROSPH_DISPATCH
  if (units == VectorUnits::avx512) return avx512::consistent_kernels;
  if (units == VectorUnits::avx2) return avx2::consistent_kernels;
#endif
  return portable::consistent_kernels;
}

const PaperKernels& paper_kernels([[maybe_unused]] VectorUnits units) {
#ifdef POROSPH_DISPATCH
  if (units == VectorUnits::avx512) return avx512::paper_kernels;
  if (units == VectorUnits::avx2) return avx2::paper_kernels;
#endif
  return portable::paper_kernels;
}

template <int dim>
PairWeights<dim> pair_weights([[maybe_unused]] VectorUnits units) {
  const auto of = [](PairWeights<2> plane, PairWeights<3> solid) {
    return std::get<PairWeights<dim>>(std::tuple(plane, solid));
  };
#ifdef POROSPH_DISPATCH
  if (units == VectorUnits::avx512) return of(avx512::pair_weights_in_plane, avx512::pair_weights_in_solid);
  if (units == VectorUnits::avx2) return of(avx2::pair_weights_in_plane, avx2::pair_weights_in_solid);
#endif
  return of(portable::pair_weights_in_plane, portable::pair_weights_in_solid);
}
template PairWeights<2> pair_weights<2>(VectorUnits);
template PairWeights<3> pair_weights<3>(VectorUnits);

}  // namespace porosph
