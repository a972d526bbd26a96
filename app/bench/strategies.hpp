// The scenes of the work-precision measurement and the ways to bring them to rest.
#pragma once

#include <string>
#include <vector>

namespace porosph::bench {

struct Scene {
  std::string name, file;
  bool exact;  ///< compared with an exact column; else with finite elements
  /// Damping xi near critical for the lowest mode, per Courant number and metre of spacing: c_d = xi / dt.
  double critical_damping;
  std::vector<std::string> overrides = {};
  double end = 4;              ///< the longest a run may take [s]
  std::string fast_file = {};  ///< the case that is made to come to rest soonest
};

const std::vector<Scene>& scenes();

/// One run to be made.
struct Plan {
  Scene scene;
  std::string form, strategy;
  double spacing;
  bool plain = false;

  std::string file() const;
  std::vector<std::string> overrides() const;
};

/// All of them, the most telling first.
std::vector<Plan> plans(bool quick);

}  // namespace porosph::bench
