// Which of the processor's vector units the hot loops are run with.
#pragma once

#include <string_view>
#include <vector>

namespace porosph {

enum class VectorUnits { portable, avx2, avx512 };

/// The widest that this program was built for and this processor has; or what the environment variable
/// POROSPH_VECTOR_UNITS (portable, avx2, avx512) names, for comparison. Decided once.
/// Throws std::runtime_error where there is no such name or the processor lacks them.
VectorUnits vector_units();

/// All that this program was built for and this processor has, widest first.
std::vector<VectorUnits> all_vector_units();

std::string_view vector_units_name(VectorUnits units);

}  // namespace porosph
