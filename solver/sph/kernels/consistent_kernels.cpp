// Compiled once for each kind of vector units, into a namespace of that name. Everything that it calls must
// be inlined: a function shared with other files could be linked in from here and be too wide for a
// processor.
#include "solver/sph/kernels/consistent_loops.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {

extern const ConsistentKernels consistent_kernels;
const ConsistentKernels consistent_kernels = loops_in<Plane>;

}  // namespace porosph::POROSPH_VECTOR_UNITS
