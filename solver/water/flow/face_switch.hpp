// Which patches of rain and seepage faces hold their limit, and which pass their rate.
#pragma once

#include <span>
#include <vector>

#include "solver/water/flow/darcy_flow.hpp"

namespace porosph {

/// A patch passes at most what is supplied to it, a seepage face nothing inwards: it is held at its limit of
/// pressure head as long as less than that enters, and at its driest one as long as more would leave by the
/// supply than the soil gives,
///
///   q = q(wet) if q(wet) < supply,  q(dry) if q(dry) > supply,  else supply.
///
/// Seepage changes patch by patch; patches of rain that one particle takes the rate of change together. One
/// that keeps changing stays where it is held by nothing: the water table meets the face there, to within a
/// patch.
class FaceSwitch {
 public:
  FaceSwitch(const DarcyFlow& flow, std::size_t patches, int most_flips)
      : flow_(flow), flips_(patches, 0), most_flips_(most_flips) {}

  /// Puts all patches in the state that the heads ask for, which are a solution with the states as they are;
  /// returns whether any changed. `storing`: what each particle takes up [m2/s]; empty in steady flow.
  bool update(std::span<const double> head, FaceConditions& faces, std::span<const double> storing = {});

 private:
  /// What patches that change together pass [m2/s].
  struct Group {
    std::vector<std::int32_t> patches = {};
    double supply = 0, through = 0, wet = 0, dry = 0;
  };
  bool set(std::int32_t patch, PatchState state, FaceConditions& faces);
  bool update_seepage(std::span<const double> head, std::span<const double> through, double tiny,
                      FaceConditions& faces);
  bool update_rain(std::span<const double> head, std::span<const double> through, double tiny,
                   FaceConditions& faces);
  PatchState by_flow(const Group& group, PatchState now, double tiny) const;
  PatchState by_pressure(double psi, const Group& group, const FaceConditions& faces, double tiny) const;

  const DarcyFlow& flow_;
  std::vector<int> flips_;
  int most_flips_;
};

}  // namespace porosph
