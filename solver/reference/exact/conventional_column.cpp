#include "solver/reference/exact/conventional_column.hpp"

#include <algorithm>

#include "solver/reference/exact/root.hpp"

namespace porosph {

FiniteStrainColumn conventional_column(const Column& column) {
  FiniteStrainColumn exact(column);
  const double initial_depth = column.water_level - column.height;
  if (initial_depth + exact.settlement() <= 0) return exact;

  const auto excess = [&](double surface_stress) {
    const double depth = initial_depth + FiniteStrainColumn(column, surface_stress).settlement();
    return surface_stress - column.unit_weight_water * depth;
  };
  // Tension raises the ground: the depth without it is the largest.
  const double most = column.unit_weight_water * (initial_depth + exact.settlement());
  return FiniteStrainColumn(column, find_root(excess, 0, most));
}

}  // namespace porosph
