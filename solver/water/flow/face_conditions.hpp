// What holds at the outline's patches now: heads that are given, rates, and what rain and seepage have found.
#pragma once

#include <optional>
#include <vector>

#include "solver/water/flow/outline.hpp"

namespace porosph {

/// What holds where a face gives water or takes it only so far.
enum class PatchState : std::uint8_t {
  rate,  ///< the rate of rain or evaporation, none on a seepage face
  wet,   ///< as much as enters or leaves at the pressure head `ponding`
  dry    ///< as much as evaporates at the pressure head `driest`
};

/// The face at a time [s]: level and rate as they are then.
HydraulicFaceCase face_now(HydraulicFaceCase face, double time);

class FaceConditions {
 public:
  FaceConditions() = default;
  /// At t = 0. Seepage faces begin wet, rain with its rate. `submerged`: all faces lie below their levels,
  /// which may then count from any height.
  FaceConditions(const HydraulicOutline& outline, const std::vector<HydraulicFaceCase>& faces,
                 bool submerged = false);

  /// Levels and rates become those of a time [s].
  void set_time(double time);

  /// The head that a patch has where a line through it passes at a height, for what is mirrored about a foot
  /// at another height [m]; nothing where the patch is closed to heads.
  std::optional<double> head(std::int32_t patch, double crossing, double foot) const {
    const Condition& c = of_patch_[patch];
    if (c.kind == FaceKind::head && (submerged_ || crossing <= c.level)) return c.level;
    if (c.limited && state_[patch] != PatchState::rate) return foot + limit(patch, state_[patch]);
    return std::nullopt;
  }
  /// Whether water passes it only so far: rain, and seepage, also above a level.
  bool switches(std::int32_t patch) const {
    const Condition& c = of_patch_[patch];
    return c.limited && !(c.kind == FaceKind::head && (submerged_ || c.height <= c.level));
  }
  bool is_rain(std::int32_t patch) const { return of_patch_[patch].kind == FaceKind::rain; }
  bool open(std::int32_t patch) const { return state_[patch] != PatchState::rate; }
  PatchState state(std::int32_t patch) const { return state_[patch]; }
  void set_state(std::int32_t patch, PatchState state) { state_[patch] = state; }
  bool is_dry(std::int32_t patch) const { return switches(patch) && state_[patch] == PatchState::dry; }
  /// Pressure head at which it is held in a state [m].
  double limit(std::int32_t patch, PatchState state) const {
    return state == PatchState::dry ? of_patch_[patch].driest : of_patch_[patch].ponding;
  }
  /// What falls on it, per area [m/s]; what the soil takes of that its state tells.
  double supply(std::int32_t patch) const { return of_patch_[patch].rate; }
  /// That enters the soil by itself, whatever the head [m/s].
  double rate(std::int32_t patch) const {
    return switches(patch) && state_[patch] != PatchState::rate ? 0 : of_patch_[patch].rate;
  }
  std::size_t size() const { return of_patch_.size(); }
  std::vector<PatchState>& states() { return state_; }

 private:
  struct Condition {
    FaceKind kind = FaceKind::closed;
    bool limited = false;
    double level = 0, rate = 0;
    double ponding = 0, driest = 0;
    double height = 0;  ///< y of its middle [m]
    double plan = 1;    ///< its length on plan over its length [-]
    int face = -1;
  };
  bool submerged_ = false;
  std::vector<Condition> of_patch_;
  std::vector<PatchState> state_;
  std::vector<HydraulicFaceCase> changing_;  ///< the case's faces; empty where none changes
};

}  // namespace porosph
