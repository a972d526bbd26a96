// Steady flow of the pore water between its faces.
#pragma once

#include <string>
#include <vector>

#include "solver/water/flow/darcy_flow.hpp"

namespace porosph {

struct SteadySeepage {
  std::vector<double> head;  ///< of the particles [m]
  FaceConditions faces;      ///< seepage faces as they have been found
  int newton_steps = 0, krylov_iterations = 0;
  double left = 0;  ///< largest inflow that remains in a particle, over all that flows in [-]
};

/// Solves R(h) = 0 by Newton's method, and opens and closes seepage faces until water leaves through those
/// that are open and presses on none that is closed. Throws std::runtime_error with the place where a part of
/// the soil has no face with a head, or where it does not converge.
SteadySeepage solve_steady(const DarcyFlow& flow, FaceConditions faces, std::vector<double> start);

/// The highest level of all faces everywhere: the soil full of water, from which it drains.
std::vector<double> start_of_steady(const std::vector<HydraulicFaceCase>& faces,
                                    std::span<const double> height);

/// Into the soil through each of the case's faces [m2/s].
std::vector<double> through_faces(const DarcyFlow& flow, const HydraulicOutline& outline,
                                  std::span<const double> head, const FaceConditions& conditions,
                                  std::size_t faces);

}  // namespace porosph
