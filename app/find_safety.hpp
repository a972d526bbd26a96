// The factor of safety of a case, or of one of its stages, and its files.
#pragma once

#include <filesystem>
#include <string>

#include "vtk_io/run_folder/safety_files.hpp"

namespace porosph::app {

/// Whatever the number of cores: which factors are tried, and with them the bracket, depend on it.
inline constexpr int trials_at_a_time = 2;

struct SafetyRequest {
  bool by_particles = true, by_limit_equilibrium = true;
  double bracket = 0.01;
  int jobs = trials_at_a_time;       ///< each on one core
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

/// Table and picture of the factor over a setting, in a folder that exists. Throws WriteError.
void write_curve(const SafetyCurve& curve, const std::filesystem::path& folder);

/// A line for each method.
std::string tell(const SafetyAnswer& answer);

}  // namespace porosph::app
