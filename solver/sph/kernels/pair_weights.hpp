// How much each neighbour of a particle counts, from where they are.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/sph/kernel/cubic_spline.hpp"
#include "solver/sph/kernels/vector_units.hpp"

namespace porosph {

template <int dim>
struct WeighedPoints {
  const double* points;   ///< dim numbers each [m]
  const double* volumes;  ///< [m^dim]
  CubicSpline<dim> kernel;
};

/// Writes w of G = V_b grad_a W_ab = w (x_b - x_a) of particle a and each of its `count` neighbours
/// [1/m^2].
template <int dim>
using PairWeights = void (*)(const WeighedPoints<dim>&, std::int32_t a, const std::int32_t* neighbours,
                             std::int64_t count, double* w);

/// That compiled for these vector units, which the program must have.
template <int dim>
PairWeights<dim> pair_weights(VectorUnits units);

/// Those weights by this processor's units, until the thread asks for others.
template <int dim>
std::span<const double> weights_of(std::int32_t a, std::span<const std::int32_t> neighbours,
                                   const WeighedPoints<dim>& all) {
  static const PairWeights<dim> weigh = pair_weights<dim>(vector_units());
  thread_local std::vector<double> w;
  if (w.size() < neighbours.size()) w.resize(neighbours.size());
  weigh(all, a, neighbours.data(), std::ssize(neighbours), w.data());
  return std::span(w).first(neighbours.size());
}

}  // namespace porosph
