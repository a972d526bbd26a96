// The files of a factor of safety.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver/output/frame.hpp"
#include "solver/reference/limit_equilibrium/search.hpp"
#include "solver/run/strength_reduction.hpp"

namespace porosph {

/// What was found for a case, by the methods that were asked for.
struct SafetyAnswer {
  std::string title;
  std::optional<StrengthReduction> particles;
  std::optional<limit_equilibrium::CriticalSurfaces> limit_equilibrium;
  std::vector<std::string> warnings;
  double particle_seconds = 0, limit_equilibrium_seconds = 0;  ///< of wall time
};

/// A slip surface with its name: "Bishop on circles".
struct NamedSurface {
  std::string name;
  limit_equilibrium::CriticalSurface surface;
};
std::vector<NamedSurface> slip_surfaces(const SafetyAnswer& answer);

/// "at rest", "moved far", ...
std::string_view words_of(TrialEnd end);

/// "1.204 to 1.212", "above 50".
std::string bracket_text(double stable_at, double fails_at);
inline std::string bracket_text(const StrengthReduction& found) {
  return bracket_text(found.stable_at, found.fails_at);
}

/// What a run's summary says of it.
Summary::Safety in_short(const SafetyAnswer& answer);

/// Where a run keeps the files of a stage's factor of safety, in its folder; nothing for a name that is not
/// that of a stage.
std::string safety_folder(const std::string& stage);

/// Says so where the two methods are more than 5 % apart; empty where they agree, or one is missing.
std::string disagreement(const SafetyAnswer& answer);

/// factor, largest displacement, unbalanced force ratio, steps and end of each trial, by the factor. Throws
/// WriteError.
void write_trials(const std::filesystem::path& file, const StrengthReduction& found);
/// surface, x, y: the corners of each slip surface. Throws WriteError.
void write_slip_surfaces(const std::filesystem::path& file, const SafetyAnswer& answer);
/// What was found with each value of a setting.
struct SafetyCurve {
  std::string title, key, unit;  ///< "water.level", "m"
  std::vector<double> values;
  std::vector<SafetyAnswer> answers;  ///< one for each
};
/// The bracket and the factor of each kind of slip surface, by the setting's value; nan where there is none.
/// Throws WriteError.
void write_safety_curve(const std::filesystem::path& file, const SafetyCurve& curve);

/// Both numbers, the bracket and what they took. Throws WriteError.
void write_safety_summary(const std::filesystem::path& file, const SafetyAnswer& answer);

}  // namespace porosph
