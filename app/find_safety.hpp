// The factor of safety of a case, or of one of its stages, and its files.
#pragma once

#include <filesystem>
#include <string>

#include "vtk_io/run_folder/safety_files.hpp"

namespace porosph::app {

struct SafetyRequest {
  bool by_particles = true, by_limit_equilibrium = true;
  double bracket = 0.01;
  int jobs = 1;
  const HandedOver* from = nullptr;  ///< state that the particles begin with; null: that of the case's start
  bool quiet = false;                ///< not a line for each trial
};

/// Limit equilibrium tells strength reduction where to begin, also where its own answer is not asked for. An
/// interruption leaves it without a bracket. Throws what reduce_strength throws.
SafetyAnswer find_safety(const Case& scene, const SafetyRequest& request);

/// Tables, pictures and the page, in a folder that exists. `command`: the command line that makes them.
/// Throws WriteError.
void write_safety(const Case& scene, const SafetyAnswer& answer, const std::string& command,
                  const std::filesystem::path& folder);

/// A line for each method.
std::string tell(const SafetyAnswer& answer);

}  // namespace porosph::app
