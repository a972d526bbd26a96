// Calls a step for each soil law among some particles. For the kernels only, which are compiled for each kind
// of vector units.
#pragma once

#include <algorithm>
#include <utility>
#include <variant>

#include "solver/sph/kernels/soil_view.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// The first range that reaches beyond the particle.
inline const SoilRange* range_at(const SoilView& soils, std::int32_t particle) {
  std::int32_t low = 0, high = soils.count - 1;
  while (low < high) {
    const std::int32_t middle = (low + high) / 2;
    if (soils.ranges[middle].last <= particle)
      low = middle + 1;
    else
      high = middle;
  }
  return soils.ranges + low;
}

/// Calls use(from, to, law, own_side) for the particles first to last - 1, soil by soil.
template <class Use>
inline void for_each_soil(const SoilView& soils, std::int32_t first, std::int32_t last, Use&& use) {
  for (const SoilRange* range = range_at(soils, first); first < last; ++range) {
    const std::int32_t end = range->last < last ? range->last : last;
    use(first, end, soils.laws[range->soil],
        range->own_side < 0 ? -1 : range->own_side + first - range->first);
    first = end;
  }
}

/// History of particle i, and back. Number by number: what is copied as a whole stays in memory, and the
/// loop around it does not become vector code.
template <SoilLaw Law>
[[gnu::always_inline]] inline typename Law::History load_history(double* const* fields, std::int32_t i) {
  typename Law::History q;
  static_assert(history_size<Law> == 0 || sizeof q == history_size<Law> * sizeof(double));
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    ((reinterpret_cast<double*>(&q)[k] = fields[k][i]), ...);
  }
  (std::make_index_sequence<history_size<Law>>());
  return q;
}
template <SoilLaw Law>
[[gnu::always_inline]] inline void store_history(double* const* fields, std::int32_t i,
                                                 const typename Law::History& q) {
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    ((fields[k][i] = reinterpret_cast<const double*>(&q)[k]), ...);
  }
  (std::make_index_sequence<history_size<Law>>());
}

/// Calls use.template operator()<Law>() with the law of this place in the list.
template <class Use, SoilLaw... Law>
inline void with_law(LawList<Law...>, std::size_t kind, Use&& use) {
  std::size_t place = 0;
  ((kind == place++ ? use.template operator()<Law>() : void()), ...);
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
