// Energies and the measure of equilibrium. Sums run in the particles' order, so they do not depend on
// threads.
#pragma once

#include <span>

#include "solver/model/model.hpp"

namespace porosph {

double kinetic_energy(const Particles& particles, std::span<const Vec2> velocity);  ///< [J/m]
/// Energy of the effective stress, sigma' : C^-1 : sigma' / 2 over the present volumes [J/m].
double elastic_energy(const Model& model);
double elastic_energy(const Model& model, std::size_t particle);  ///< its share [J/m]
double gravity_energy(const Model& model);  ///< of the soil's weight, zero at the start [J/m]
/// Of the pore pressure's body force in still water, zero at the start: grad p_w acts on each particle's
/// volume, so with small strains this is gamma_w times depth lost, over the wet volumes [J/m].
double water_energy(const Model& model);

/// Root mean square of mass times acceleration over that of the weight; infinite where nothing weighs [-].
double unbalanced_force_ratio(const Model& model, std::span<const Vec2> accelerations,
                              double squares_of_loads = 0);

}  // namespace porosph
