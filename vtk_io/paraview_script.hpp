// The ParaView Python scripts that open particle series ready to look at.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/output/frame.hpp"

namespace porosph {

inline constexpr const char* open_script = "open_in_paraview.py";        ///< beside a series
inline constexpr const char* compare_script = "compare_in_paraview.py";  ///< two runs side by side

/// What a script draws around the particles.
struct ScriptScene {
  std::string title;
  double spacing = 0;           ///< of the particles [m]; 0: estimated by the script
  double smoothing_length = 0;  ///< h [m], for sections; 0: none is prepared
  bool boundary = false;        ///< whether the series has a second block
  std::vector<ProbeCase> probes;
  WaterCase water;
  std::vector<SoilCase> soils;  ///< for their outlines
  std::vector<BoundaryCase> boundaries;
};
ScriptScene script_scene(const Case& scene);

/// Python text, for ParaView 5.11 or later: shows `pvd` (a name) in the script's own folder, or else in
/// `folder`, coloured by the vertical effective stress in kPa or, where `frame` has none, its first field;
/// with time, outlines, supports, probes and water levels, and a section ready to be computed.
std::string paraview_script(const std::filesystem::path& folder, const std::string& pvd, const Frame& frame,
                            const ScriptScene& scene = {});

/// Shows two runs, `a` and `b`, given by their folders, side by side with linked cameras, one time and one
/// range of colours. Relative ones are seen from the script's own, or else from `folder`. An empty one is
/// asked for when the script is started. Each folder must hold an open_in_paraview.py.
std::string paraview_comparison_script(const std::filesystem::path& folder, const std::filesystem::path& a,
                                       const std::filesystem::path& b);

}  // namespace porosph
