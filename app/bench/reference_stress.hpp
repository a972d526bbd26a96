// The vertical effective stress that a scene comes to rest at, and how far a state is from it.
#pragma once

#include <vector>

#include "solver/reference/fem/solution.hpp"
#include "solver/run/simulation.hpp"

namespace porosph::bench {

/// Places of the embankment where stress is singular or lacks derivatives count in no error: 1 m around its
/// toes, 0.5 m around the ends of its crest.
bool counts(const Case& scene, const Point& place);

class ReferenceStress {
 public:
  /// The exact column that the case names, or else the finite elements, at the particles' starting positions.
  ReferenceStress(const Simulation& simulation, const FemSolution* fem);

  /// Relative L2 norm of the error of sigma'_yy.
  double error(const Simulation& simulation) const;

 private:
  std::vector<double> stress_;  ///< by particle id [Pa]; not a number where it does not count
};

}  // namespace porosph::bench
