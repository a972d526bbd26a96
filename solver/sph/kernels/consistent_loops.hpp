// The hot loops of the consistent form in any space. For the kernels only, which are compiled for each kind
// of vector units.
#pragma once

#include "solver/sph/kernels/accelerations.hpp"
#include "solver/sph/kernels/strain.hpp"
#include "solver/sph/kernels/stress_diffusion.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

template <class Space>
void rates(const ConsistentArraysIn<Space>& c, std::int32_t number, double* out) {
  constexpr int size = gradient_size<Space>;
  const TileRange tile = range_of(*c.reference.stencils, number);
  Row rate[size];
  tile_rates(c, tile, rate);
  for (std::int32_t i = 0; i < tile.last - tile.first; ++i)
    for (int k = 0; k < size; ++k) out[size * i + k] = rate[k].value[i];
}

template <class Space>
void strain(const ConsistentArraysIn<Space>& c, std::int32_t number, double dt, LargestChange& largest) {
  strain_tile(c, range_of(*c.reference.stencils, number), dt, largest);
}

template <class Space>
void accelerate(const ConsistentArraysIn<Space>& c, std::int32_t number, double* out) {
  const TileRange tile = range_of(*c.reference.stencils, number);
  const auto with = [&]<bool varies>() {
    c.motion.pressure ? accelerate_tile<Space, true, varies>(c, tile, out)
                      : accelerate_tile<Space, false, varies>(c, tile, out);
  };
  c.flow.viscosity ? with.template operator()<true>() : with.template operator()<false>();
}

template <class Space>
void gradients_of_stress(const ConsistentArraysIn<Space>& c, std::int32_t number) {
  stress_gradients(c, range_of(*c.reference.stencils, number));
}

template <class Space>
void diffusion(const ConsistentArraysIn<Space>& c, std::int32_t number) {
  diffuse(c, range_of(*c.reference.stencils, number));
}

template <class Space>
constexpr ConsistentKernelsIn<Space> loops_in = {rates<Space>, strain<Space>, accelerate<Space>,
                                                 gradients_of_stress<Space>, diffusion<Space>};

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
