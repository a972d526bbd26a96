// How far a run at rest is from finite elements, as summary.json tells it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace porosph {

/// One component of a field over the particles of one soil.
struct FemDifference {
  double relative_l2 =
      0;  ///< ||run - elements|| / ||elements||, volume-weighted; NaN where the latter is zero
  double relative =
      0;               ///< the same over max(||elements||, a fifth of the whole field's norm): what is judged
  double max_abs = 0;  ///< largest |run - elements|, in the field's unit
  double x = 0, y = 0;  ///< where that is, at t = 0 [m]
  /// The largest of a patch of four by four spacings, over the patch's own norm; at least, a stress is
  /// measured by the weight of soil as high as the patch, a displacement by half of the field's norm.
  double local = 0;
  double local_x = 0, local_y = 0;  ///< where that patch's particles have their centre, at t = 0 [m]
};

struct FemSoilCheck {
  std::int64_t particles = 0;  ///< that were compared
  std::int64_t left_out = 0;   ///< near points where stress is singular
  double strain = 0;           ///< root mean square of the largest principal strain, by elements
  std::map<std::string, FemDifference> fields;  ///< EffectiveStress_XX, ..., Displacement_Y
};

struct FemCheck {
  std::string skipped;  ///< why nothing was compared; empty where it was
  double unknowns = 0;
  double seconds = 0;                         ///< mesh, solution and comparison
  double limit = 0;                           ///< of FemDifference::relative, beyond which there is a warning
  double local_limit = 0;                     ///< of FemDifference::local
  std::map<std::string, FemSoilCheck> soils;  ///< by name
  /// What finite elements say at the probes: EffectiveStress_XX, ..., Displacement_Y, by the probe's name
  /// [SI].
  std::map<std::string, std::map<std::string, double>> probes;
  std::vector<std::string> warnings;  ///< soil, field, value, place and cause
};

}  // namespace porosph
