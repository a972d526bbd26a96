// From vector units to the kernels compiled for them.
#include "solver/motion/kernels/consistent_kernels.hpp"

namespace porosph {

#ifdef POROSPH_DISPATCH
namespace avx512 {
extern const ConsistentKernels consistent_kernels;
}
namespace avx2 {
extern const ConsistentKernels consistent_kernels;
}
#endif
namespace portable {
extern const ConsistentKernels consistent_kernels;
}

const ConsistentKernels& consistent_kernels([[maybe_unused]] VectorUnits units) {
#ifdef POROSPH_DISPATCH
  if (units == VectorUnits::avx512) return avx512::consistent_kernels;
  if (units == VectorUnits::avx2) return avx2::consistent_kernels;
#endif
  return portable::consistent_kernels;
}

}  // namespace porosph
