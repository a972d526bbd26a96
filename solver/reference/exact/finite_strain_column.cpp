#include "solver/reference/exact/finite_strain_column.hpp"

#include <algorithm>
#include <cmath>

#include "solver/reference/exact/root.hpp"

namespace porosph {

double FiniteStrainColumn::Layer::s(double initial_height) const {
  return s_top - std::log1p((1 - b / a * std::exp(s_top)) * std::expm1(a * (top - initial_height)));
}

double FiniteStrainColumn::Layer::present_thickness(double initial_height) const {
  const double thickness = initial_height - bottom, s_bottom = s(bottom);
  if (b > 0) return (a * thickness - (s(initial_height) - s_bottom)) / b;
  return std::exp(s_bottom) * std::expm1(a * thickness) / a;
}

FiniteStrainColumn::FiniteStrainColumn(const Column& column, double surface_stress) : column_(column) {
  check(column);
  const double surface_s = surface_stress / column.constrained_modulus();
  const double level = std::clamp(column.water_level, 0.0, column.height);
  build(surface_s, level);
  if (level <= 0 || level >= column.height) return;

  // Soil up to the initial height `wetted` ends up below the water level. The wider it reaches the more soil
  // is buoyant, and the lower its top stands below the level if it is taken too low.
  const auto above_level = [&](double wetted) {
    build(surface_s, wetted);
    return present_height(wetted) - level;
  };
  if (above_level(column.height) > 0) build(surface_s, find_root(above_level, level, column.height));
}

void FiniteStrainColumn::build(double surface_s, double wetted_height) {
  const double modulus = column_.constrained_modulus();
  const double saturated_height = std::clamp(column_.water_level, 0.0, column_.height);
  const double a_unsaturated = column_.unit_weight_unsaturated / modulus;
  const double a_saturated = column_.unit_weight_saturated / modulus;
  const double b = column_.unit_weight_water / modulus;
  layers_.clear();
  const auto add = [&](double bottom, double top, double a, double buoyancy) {
    if (bottom >= top) return;
    const double s_top = layers_.empty() ? surface_s : layers_.back().s(layers_.back().bottom);
    layers_.push_back({bottom, top, a, buoyancy, s_top, 0});
  };
  add(wetted_height, column_.height, a_unsaturated, 0);
  add(saturated_height, wetted_height, a_unsaturated, b);
  add(0, saturated_height, a_saturated, b);
  for (auto layer = layers_.rbegin() + 1; layer != layers_.rend(); ++layer) {
    const Layer& below = *std::prev(layer);
    layer->present_bottom = below.present_bottom + below.present_thickness(below.top);
  }
}

const FiniteStrainColumn::Layer& FiniteStrainColumn::layer_at(double initial_height) const {
  const auto found =
      std::ranges::find_if(layers_, [&](const Layer& l) { return initial_height >= l.bottom; });
  return found == layers_.end() ? layers_.back() : *found;
}

double FiniteStrainColumn::present_height(double initial_height) const {
  const Layer& layer = layer_at(initial_height);
  return layer.present_bottom + layer.present_thickness(initial_height);
}

double FiniteStrainColumn::vertical_stress(double initial_height) const {
  return column_.constrained_modulus() * layer_at(initial_height).s(initial_height);
}

double FiniteStrainColumn::lateral_stress(double initial_height) const {
  return column_.lame_lambda() / column_.constrained_modulus() * vertical_stress(initial_height);
}

double FiniteStrainColumn::displacement(double initial_height) const {
  return present_height(initial_height) - initial_height;
}

}  // namespace porosph
