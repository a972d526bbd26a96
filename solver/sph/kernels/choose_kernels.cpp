// From vector units to the kernels compiled for them.
#include "solver/sph/kernels/consistent_kernels.hpp"
#include "solver/sph/kernels/paper_kernels.hpp"

namespace porosph {

#ifdef POROSPH_DISPATCH
namespace avx512 {
extern const ConsistentKernels consistent_kernels;
extern const PaperKernels paper_kernels;
}  // namespace avx512
namespace avx2 {
extern const ConsistentKernels consistent_kernels;
extern const PaperKernels paper_kernels;
}  // namespace avx2
#endif
namespace portable {
extern const ConsistentKernels consistent_kernels;
extern const PaperKernels paper_kernels;
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

}  // namespace porosph
