// The outside of the soils as water sees it: straight stretches, cut into patches with a condition each.
#pragma once

#include <span>
#include <vector>

#include "solver/boundary/wall.hpp"
#include "solver/case/case.hpp"
#include "solver/case/flow_case.hpp"

namespace porosph {

/// A short piece of a stretch of the outline.
struct HydraulicPatch {
  int stretch;                ///< index into HydraulicOutline::stretches
  double from, to;            ///< distance along it [m]
  int face;                   ///< index into the case's faces; -1 where none is named
  Vec2 place = Vec2::Zero();  ///< of one in the soil (a drain), whose stretch is -1 [m]
};

struct HydraulicOutline {
  std::vector<Wall> stretches;          ///< mirrors for the images of particles; soil on the normal's side
  std::vector<HydraulicPatch> patches;  ///< by stretch, then along it
  std::vector<std::int32_t> first;      ///< patch of each stretch, and one past the last

  Vec2 at(int stretch, double along) const {
    const Wall& w = stretches[stretch];
    return w.from + along * (w.to - w.from).normalized();
  }
  /// How far along a stretch a point lies beside it [m].
  double along(int stretch, const Vec2& p) const {
    const Wall& w = stretches[stretch];
    return (p - w.from).dot((w.to - w.from).normalized());
  }
  Vec2 middle(const HydraulicPatch& p) const {
    return p.stretch < 0 ? p.place : at(p.stretch, (p.from + p.to) / 2);
  }
  /// The stretch that water passes on its way back from where it comes to through this one: itself, but of
  /// periodic sides the other one.
  int way_back(int stretch) const;
  /// The patch at a distance along a stretch; beyond an end, that which lies as far before it.
  int patch_at(int stretch, double along) const;
};

/// Of the outline that no other soil covers; stretches of several soils that continue in one line are one. Of
/// faces that overlap the later one holds. Patches are at most half a spacing [m] long. Those of `boundaries`
/// that are periodic come last and are so here.
HydraulicOutline hydraulic_outline(const std::vector<SoilCase>& soils,
                                   const std::vector<HydraulicFaceCase>& faces, double spacing,
                                   std::span<const BoundaryCase> boundaries = {});

/// The first stretch of the outline that no face names, "(x, y) to (x, y)"; empty where all is named.
std::string unnamed_stretch(const HydraulicOutline& outline);
/// Whether a face lies on the outline at all.
bool touches(const HydraulicFaceCase& face, const std::vector<SoilCase>& soils, double spacing);

}  // namespace porosph
