// How much inertia the soils of a case have on their way to rest.
#pragma once

#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// M / rho of a soil in its lightest state; 0 of one without weight [m2/s2].
double modulus_over_density(const SoilCase& soil, double gravity);

/// Why soils cannot have another inertia than their mass in a case; empty where they can: where nothing but
/// the state of rest of elastic soil is asked for.
std::string inertia_obstacle(const Case&);

/// Inertia over mass of each soil: 1, or where loading.scaled_inertia applies so much that no wave is faster
/// than in the softest soil. docs/theory.md says what it does.
std::vector<double> inertia_over_mass(const Case&);

}  // namespace porosph
