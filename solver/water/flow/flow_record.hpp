// How water flows at an instant, as the output tells it.
#pragma once

#include <vector>

#include "solver/space/tensor.hpp"

namespace porosph {

struct FlowRecord {
  std::vector<double> head;              ///< h = psi + y of the particles, relative to the model's origin [m]
  std::vector<Vec2> velocity;            ///< w = -K kr grad h [m/s]
  std::vector<Vec2> gradient;            ///< i = -grad h [-]
  std::vector<double> saturation;        ///< Se [-]
  std::vector<double> through_faces;     ///< into the soil through each of the case's faces [m2/s]
  std::vector<double> through_sections;  ///< from the left of each to its right [m2/s]
  double imbalance = 0;                  ///< what enters less what leaves, over what enters [-]
  int newton_steps = 0, krylov_iterations = 0;
};

}  // namespace porosph
