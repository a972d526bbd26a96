#include "solver/analysis/field_norms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace porosph {
namespace {

const std::vector<FieldSelection> fields = {{"Displacement", "X"},     {"Displacement", "Y"},
                                            {"EffectiveStress", "XX"}, {"EffectiveStress", "YY"},
                                            {"EffectiveStress", "ZZ"}, {"EffectiveStress", "XY"},
                                            {"TotalStress", "YY"},     {"PorePressure", ""}};

}  // namespace

FieldNorms norms(const FieldSelection& field, const std::vector<double>& values,
                 const std::vector<double>& reference, const std::vector<Point>& at,
                 const std::vector<double>& volumes, double scale) {
  FieldNorms n{.field = field};
  double difference = 0, whole = 0, volume = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double d = values[i] - reference[i];
    difference += volumes[i] * d * d;
    whole += volumes[i] * reference[i] * reference[i];
    volume += volumes[i];
    if (std::abs(d) > n.max_abs || !std::isfinite(d)) n.max_abs = std::abs(d), n.where = at[i];
    if (!std::isfinite(d)) break;
  }
  const bool is_zero = std::sqrt(whole / volume) <= 1e-9 * scale;
  n.relative_l2 = is_zero ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(difference / whole);
  return n;
}

std::vector<FieldSelection> comparable_fields(const Frame& a, const Frame& b) {
  std::vector<FieldSelection> both;
  for (const FieldSelection& f : fields)
    if (has_field(a, f.name) && has_field(b, f.name)) both.push_back(f);
  return both;
}

double largest_component(const Frame& frame, const std::string& name) {
  double scale = 0;
  for (const FieldSelection& f : fields)
    if (f.name == name) scale = std::max(scale, largest_of(values_of(frame, f)));
  return scale;
}

}  // namespace porosph
