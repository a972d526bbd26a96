#include "solver/analysis/exact_state.hpp"

#include "solver/analysis/derived_fields.hpp"
#include "solver/reference/exact/conventional_column.hpp"
#include "solver/reference/exact/finite_strain_column.hpp"
#include "solver/run/reference_errors.hpp"
#include "solver/water/still_water.hpp"

namespace porosph {

std::optional<Frame> exact_state(const Case& scene, const std::vector<Point>& starts) {
  if (scene.reference == Reference::none) return std::nullopt;
  const auto [column, bottom] = reference_column(scene);
  const FiniteStrainColumn exact = scene.reference == Reference::conventional_column
                                       ? conventional_column(column)
                                       : FiniteStrainColumn(column);
  const StandingWater water(at_rest_from(scene.water, scene.time.end));
  std::vector<double> stress, displacement, pressure;
  Frame frame;
  for (const Point& start : starts) {
    const double height = start.y() - bottom, lateral = exact.lateral_stress(height),
                 u = exact.displacement(height);
    stress.insert(stress.end(), {lateral, exact.vertical_stress(height), lateral, 0, 0, 0});
    displacement.insert(displacement.end(), {0, u, 0});
    pressure.push_back(water.pore_pressure(start.x(), start.y() + u));
    frame.points.insert(frame.points.end(), {start.x(), start.y() + u, 0});
  }
  frame.fields = {{"EffectiveStress", component_names(FieldKind::symmetric), std::move(stress)},
                  {"Displacement", component_names(FieldKind::vector), std::move(displacement)},
                  {"PorePressure", {}, std::move(pressure)}};
  if (water.present()) add_head(frame, water.unit_weight());
  return frame;
}

}  // namespace porosph
