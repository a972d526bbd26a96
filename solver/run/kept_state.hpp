// The state of a simulation, kept in memory for others to continue from.
#pragma once

#include <vector>

#include "solver/run/simulation.hpp"

namespace porosph {

class KeptState {
 public:
  explicit KeptState(Simulation& simulation);

  /// Puts another simulation of the same case into this state, from which it continues to the same bits.
  /// Strength that was reduced is not part of it. Throws StateError where the case is another.
  void restore(Simulation& simulation) const;

  bool operator==(const KeptState&) const = default;

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace porosph
