// Warnings before a run starts.
#pragma once

#include <fmt/format.h>

#include <iostream>

#include "solver/case/known_limits.hpp"
#include "solver/output/frame.hpp"
#include "solver/simulation/simulation.hpp"

namespace porosph::app {

/// Says on standard error which settings are known to fail.
inline void warn_of_known_failures(const Case& scene) {
  for (const std::string& text : known_failures(scene)) std::cerr << "porosph: warning: " << text << '\n';
}

/// Says on standard error where a result is far from finite elements.
inline void warn_of_differences(const Summary& summary) {
  if (!summary.finite_elements) return;
  for (const std::string& text : summary.finite_elements->warnings)
    std::cerr << "porosph: warning: " << text << '\n';
}

/// Says on standard error where steps are smaller than the case asks for.
inline void warn_of_smaller_steps(const Simulation& simulation) {
  const double asked = simulation.scene().time.courant;
  if (simulation.courant() < asked)
    std::cerr << fmt::format(
        "porosph: note: the stiffest of the disordered particles allows time.courant = {:.2g}, which is "
        "taken "
        "in place of {:g}\n",
        simulation.courant(), asked);
}

}  // namespace porosph::app
