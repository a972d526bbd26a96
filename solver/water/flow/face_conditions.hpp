// What holds at the outline's patches now: heads that are given, seepage that has been found.
#pragma once

#include <optional>
#include <vector>

#include "solver/water/flow/outline.hpp"

namespace porosph {

class FaceConditions {
 public:
  FaceConditions() = default;
  /// Seepage faces begin open.
  FaceConditions(const HydraulicOutline& outline, const std::vector<HydraulicFaceCase>& faces);

  /// The head that a patch has where a line through it passes at a height, for what is mirrored about a foot
  /// at another height [m]; nothing where the patch is closed to heads.
  std::optional<double> head(std::int32_t patch, double crossing, double foot) const {
    const Condition& c = of_patch_[patch];
    if (c.kind == FaceKind::head && crossing <= c.level) return c.level;
    if (c.seeps && open_[patch]) return foot;
    return std::nullopt;
  }
  /// Whether water may leave at it and not enter.
  bool seeps(std::int32_t patch) const {
    const Condition& c = of_patch_[patch];
    return c.seeps && !(c.kind == FaceKind::head && c.height <= c.level);
  }
  bool open(std::int32_t patch) const { return open_[patch]; }
  void set_open(std::int32_t patch, bool open) { open_[patch] = open; }
  double rate(std::int32_t patch) const { return of_patch_[patch].rate; }  ///< into the soil [m/s]
  std::size_t size() const { return of_patch_.size(); }

 private:
  struct Condition {
    FaceKind kind = FaceKind::closed;
    bool seeps = false;
    double level = 0, rate = 0;
    double height = 0;  ///< y of its middle [m]
  };
  std::vector<Condition> of_patch_;
  std::vector<std::uint8_t> open_;
};

}  // namespace porosph
