// A load that a case describes: traction on a straight stretch of the outline.
#pragma once

#include "solver/boundary/load.hpp"
#include "solver/case/case.hpp"

namespace porosph {

/// Linear along its stretch, beyond its ends as at them; times a factor that is linear between points in time
/// and constant before and after.
class Traction final : public Load {
 public:
  explicit Traction(LoadCase load) : load_(std::move(load)) {}
  Vec2 traction(const Vec2& place, const Vec2& normal, double time) const override;

 private:
  LoadCase load_;
};

/// The unit normal of a stretch of the outline that points out of the soil.
Vec2 outward_normal(const Case& scene, const Point& from, const Point& to);

/// Linear between points (time, factor), constant before and after; 1 where there are none.
double factor_at(const std::vector<Point>& over_time, double time);

/// The load as it stands at a time [s], from then on.
LoadCase at_rest_from(LoadCase load, double time);
/// The footing under the force, or at the settlement, that it has at a time [s].
FootingCase at_rest_from(FootingCase footing, double time);

}  // namespace porosph
