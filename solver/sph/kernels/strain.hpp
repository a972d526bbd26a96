// A tile's step, each particle by the law of its soil. For the kernels only, which are compiled for each kind
// of vector units.
#pragma once

#include "solver/sph/kernels/external_step.hpp"
#include "solver/sph/kernels/interface_step.hpp"
#include "solver/sph/kernels/material_step.hpp"
#include "solver/sph/kernels/velocity_gradients.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// Interfaces are known in the plane only.
template <class Space, SoilLaw<Space> Law, Watch watch>
LargestChange step_of(const ConsistentArraysIn<Space>& c, const TileStep<Space>& tile, std::int32_t first,
                      std::int32_t last, const LawView& law, double elastic, std::int32_t place) {
  if constexpr (std::is_same_v<Space, Plane>)
    if (place >= 0) {
      const OwnSideStep side(c, tile.particle + first, place);
      return material_step<Space, Law, watch>(tile, side, first, last, law);
    }
  return material_step<Space, Law, watch>(tile, OneSoilStep<Space>{elastic}, first, last, law);
}

/// Particles first to last - 1 of the tile, which have this law.
template <class Space>
LargestChange step_by_law(const ConsistentArraysIn<Space>& c, const TileStep<Space>& tile, std::int32_t first,
                          std::int32_t last, const LawView& law, double elastic, std::int32_t place) {
  if constexpr (std::is_same_v<Space, Plane>)
    if (law.kind == Laws::size) return external_step(c, tile, first, last, law, elastic, place);
  LargestChange change;
  with_law(Laws{}, law.kind, [&]<class Law>() {
    if constexpr (SoilLaw<Law, Space>) {
      const auto stepped = [&]<Watch watch>() {
        return step_of<Space, Law, watch>(c, tile, first, last, law, elastic, place);
      };
      change = tile.flow.viscosity                  ? stepped.template operator()<Watch::flow>()
               : tile.state.yields && law.may_yield ? stepped.template operator()<Watch::yielding>()
                                                    : stepped.template operator()<Watch::nothing>();
    }
  });
  return change;
}

/// Where soils meet, the derivative along the interface is that of the own soil.
template <class Space>
void take_own_along(const ConsistentArraysIn<Space>& c, const TileRange& tile, Row* rate) {
  if constexpr (std::is_same_v<Space, Plane>) {
    const OwnSideView& sides = c.state.own_sides;
    if (sides.change[0] == nullptr) return;
    for_each_soil(c.state.soils, tile.first, tile.last,
                  [&](std::int32_t from, std::int32_t to, const LawView&, std::int32_t place) {
                    if (place < 0) return;
                    for (std::int32_t a = from; a < to; ++a, ++place)
                      for (int k = 0; k < 4; ++k)
                        *rate[k].of(a, tile.first) += sides.change[k / 2][place] * sides.along[k % 2][place];
                  });
  }
}

template <class Space>
void keep_for_neighbours(const FluxViewIn<Space>& f, const TileRange& tile, const Row* piola) {
  constexpr int size = matrix_size<Space>;
  for (std::int32_t a = tile.first; a < tile.last; ++a) {
    if (f.listed[a])
      for (int k = 0; k < size; ++k) f.records[a].q[k] = f.flux[k][a];
    if (f.mirrored[a])
      for (int k = 0; k < size; ++k) f.piola[k][a] = piola[k].value[a - tile.first];
  }
}

template <class Space>
void strain_tile(const ConsistentArraysIn<Space>& c, const TileRange& tile, double dt,
                 LargestChange& largest) {
  Row rate[gradient_size<Space>], piola[matrix_size<Space>];
  tile_rates(c, tile, rate);
  take_own_along(c, tile, rate);
  const TileStep<Space> step(c, tile, rate, piola, dt);
  for_each_soil(c.state.soils, tile.first, tile.last,
                [&](std::int32_t from, std::int32_t to, const LawView& law, std::int32_t place) {
                  const double elastic = c.control.rate[&law - c.state.soils.laws];
                  const LargestChange change =
                      step_by_law(c, step, from - tile.first, to - tile.first, law, elastic, place);
                  largest.strain = std::max(largest.strain, change.strain);
                  largest.speed_squared = std::max(largest.speed_squared, change.speed_squared);
                  largest.plastic_work += change.plastic_work, largest.viscous_work += change.viscous_work;
                });
  keep_for_neighbours(c.fluxes, tile, piola);
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
