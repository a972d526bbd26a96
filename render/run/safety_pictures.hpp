// Pictures of a factor of safety.
#pragma once

#include <filesystem>

#include "vtk_io/run_folder/safety_files.hpp"

namespace porosph::render {

/// Displacement over the factor that strength is divided by: the curve that bends where the body fails, with
/// the factors of limit equilibrium. Throws as save_charts.
void save_safety_curve(const SafetyAnswer& answer, const std::filesystem::path& path);

/// The factor over a setting's value: the middle of each bracket, and the factors of limit equilibrium.
/// Throws as save_charts.
void save_safety_over_setting(const SafetyCurve& curve, const std::filesystem::path& path);

/// Plastic strain of the trial that failed at the smallest factor, the slip surfaces drawn over it; without
/// such a trial the soils, with the slip surfaces. Throws as save_contours.
void save_mechanism(const Case& scene, const SafetyAnswer& answer, const std::filesystem::path& path);

}  // namespace porosph::render
