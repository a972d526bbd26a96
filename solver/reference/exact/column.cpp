#include "solver/reference/exact/column.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace porosph {
namespace {

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(std::string("column: ") + what);
}

}  // namespace

void check(const Column& column) {
  require(column.height > 0, "the height must be positive");
  require(column.bulk_modulus > 0 && column.shear_modulus > 0, "the moduli must be positive");
  if (column.water_level < column.height)
    require(column.unit_weight_unsaturated > 0, "the unsaturated unit weight must be positive");
  if (column.water_level <= 0) return;
  require(column.unit_weight_water > 0, "the water's unit weight must be positive");
  require(column.unit_weight_saturated > column.unit_weight_water,
          "the saturated unit weight must exceed the water's");
  if (column.water_level < column.height)
    require(column.unit_weight_unsaturated > column.unit_weight_water,
            "the unsaturated unit weight must exceed the water's");
}

double textbook_vertical_stress(const Column& column, double height) {
  const double water_line = std::clamp(column.water_level, 0.0, column.height);
  const double dry = column.height - std::max(height, water_line);
  const double wet = std::max(water_line - height, 0.0);
  return -column.unit_weight_unsaturated * dry -
         (column.unit_weight_saturated - column.unit_weight_water) * wet;
}

}  // namespace porosph
