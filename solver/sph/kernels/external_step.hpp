// The step of a law of a program's own, which is called for all particles of a tile at once, in the plane.
// For the kernels only, which are compiled for each kind of vector units.
#pragma once

#include "solver/sph/kernels/interface_step.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// As material_step; where `place` >= 0 another soil is near.
LargestChange external_step(const ConsistentArrays& c, const TileStep<Plane>& tile, std::int32_t first,
                            std::int32_t last, const LawView& view, double elastic, std::int32_t place) {
  const TileStep<Plane> t = tile;
  const OwnSideStep side(c, place < 0 ? 0 : t.particle + first, place < 0 ? 0 : place);
  const auto& law = *static_cast<const ExternalLaw*>(view.law);
  Row rows[4];
  double* const gradient[4] = {rows[0].value, rows[1].value, rows[2].value, rows[3].value};
  std::array<Stress, PairStencils::tile> elastic_stress;
  for (std::int32_t i = first; i < last; ++i) {
    const Gradient summed = t.gradient(i), g = place < 0 ? summed : side.gradient(i - first, summed);
    elastic_stress[i - first] = law.elastic().elastic_step(t.old_stress(i), g, t.dt);
    put(gradient, i, g);
  }
  double* history[LawView::most_history];
  for (std::size_t k = 0; k < view.history_count; ++k) history[k] = view.history[k] + t.particle + first;
  SoilTile soil{.count = last - first,
                .dt = t.dt,
                .gradient = {},
                .stress = t.state.stress + 4 * first,
                .history = {history, view.history_count}};
  for (int k = 0; k < 4; ++k) soil.gradient[k] = gradient[k] + first;
  law.step(soil);
  const double modulus = law.elastic().constrained_modulus();
  double strain = 0, speed_squared = 0;
  for (std::int32_t i = first; i < last; ++i) {
    const Gradient g = gradient_at<Plane>(gradient, i);
    const Gradient f = t.deformed(i);
    const double density = t.compressed(i, f, strain, speed_squared);
    const std::int32_t j = i - first;
    const double yields = departs(t.old_stress(i), elastic_stress[j]);
    if (t.state.yields) t.state.yields[i] = yields;
    if (t.flow.viscosity) t.flow.viscosity[i] = t.control.viscosity;
    if (place < 0)
      t.write_flux(i, t.old_stress(i), f, density, modulus, g.trace(), t.controlled(i, f, elastic),
                   t.control.viscosity);
    else
      t.write_flux(i, side.tied(j, t.old_stress(i), g, t.dt, yields), f, density, modulus, g.trace(),
                   side.controlled(t, i, j, f), t.control.viscosity);
  }
  return {strain, speed_squared};
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
