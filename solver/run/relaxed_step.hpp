// A step of soil on its way to rest, whose water does not move.
#pragma once

#include "solver/model/model.hpp"
#include "solver/run/leapfrog.hpp"
#include "solver/sph/dynamics.hpp"

namespace porosph {

/// Kicks and moves the particles over dt [s] and strains them.
void relaxed_step(Model& model, Dynamics& dynamics, Kick kick, double dt,
                  std::span<const Vec2> accelerations);

/// The longer side of the box around the particles [m].
double extent_of(const Particles& particles);

}  // namespace porosph
