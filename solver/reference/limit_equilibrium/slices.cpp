#include "solver/reference/limit_equilibrium/slices.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace porosph::limit_equilibrium {
namespace {

using Column = Section::Column;

void add_force(const Point& at, const Point& force, Slice& slice) {
  slice.push += force.x(), slice.press -= force.y();
  slice.torque += at.x() * force.y() - at.y() * force.x();
}

/// What the water does that presses on a straight piece of ground from a to b, soil below or to the right of
/// it. Two Gauss points: exact for pressure that varies linearly.
void add_water(const Section& section, const Column& column, const Point& a, const Point& b, Slice& slice) {
  const double half = 0.5, offset = 0.5 / std::sqrt(3.0);
  for (const double t : {half - offset, half + offset}) {
    const Point at = a + t * (b - a);
    const double pressure = half * section.pore_pressure(column, at.x(), at.y());
    add_force(at, pressure * Point((b - a).y(), -(b - a).x()), slice);
  }
}

/// The loads on a straight piece of ground, likewise.
void add_loads(const Section& section, const Point& a, const Point& b, Slice& slice) {
  const double half = 0.5, offset = 0.5 / std::sqrt(3.0);
  for (const double t : {half - offset, half + offset}) {
    const Point at = a + t * (b - a);
    add_force(at, half * (b - a).norm() * section.traction_at(at), slice);
  }
}

class Cutter {
 public:
  Cutter(const Section& section, std::vector<Slice>& slices) : section_(section), slices_(slices) {}

  /// False where the surface leaves the soil.
  bool cut(const SlipSurface& surface) {
    tolerance_ = 1e-7 * (surface.back() - surface.front()).norm();
    for (std::size_t i = 1; i < surface.size(); ++i)
      if (!add_segment(surface[i - 1], surface[i])) return false;
    return !slices_.empty() && add_steps(surface);
  }

 private:
  bool add_segment(const Point& a, const Point& b) {
    const auto& columns = section_.columns();
    std::size_t k = section_.column_of(a.x());
    while (k < columns.size() && columns[k].to <= a.x()) ++k;
    Point left = a;
    for (; k < columns.size() && left.x() < b.x(); ++k) {
      if (columns[k].strips.empty()) return false;
      const double to = std::min(columns[k].to, b.x());
      const Point right = to == b.x() ? b : Point(a + (b - a) * ((to - a.x()) / (b.x() - a.x())));
      if (!inside(columns[k], left) || !inside(columns[k], right)) return false;
      add_slices(columns[k], left, right, 3);
      left = right;
    }
    return left.x() >= b.x();
  }

  bool inside(const Column& column, const Point& p) const {
    return p.y() <= column.ground(p.x()) + tolerance_ && p.y() >= column.floor(p.x()) - tolerance_;
  }

  int soil_at(const Column& column, const Point& p) const {
    return column.soil_at(p.x(), std::clamp(p.y(), column.floor(p.x()), column.ground(p.x())));
  }

  /// One slice, or several where the soil along the base changes.
  void add_slices(const Column& column, const Point& a, const Point& b, int most_cuts) {
    if (b.x() - a.x() <= 0) return;
    const auto soil = [&](double t) { return soil_at(column, a + t * (b - a)); };
    const int first = soil(1e-6), last = soil(1 - 1e-6), middle = soil(0.5);
    if (most_cuts > 0 && (first != last || first != middle)) {
      double same = 1e-6, other = first == middle ? 1 : 0.5;
      for (int i = 0; i < 24; ++i) {
        const double t = 0.5 * (same + other);
        (soil(t) == first ? same : other) = t;
      }
      const Point at = a + same * (b - a), beyond = a + other * (b - a);
      add_slice(column, a, at);
      return add_slices(column, beyond, b, most_cuts - 1);
    }
    add_slice(column, a, b);
  }

  void add_slice(const Column& column, const Point& a, const Point& b) {
    const Point base = 0.5 * (a + b), along = b - a;
    const double length = along.norm();
    if (along.x() <= 0) return;
    const int soil = soil_at(column, base);
    if (soil == Section::nothing) return;
    const Section::Pillar pillar = section_.pillar_above(column, base.x(), base.y());
    Slice slice{.base = base,
                .width = along.x(),
                .length = length,
                .sine = along.y() / length,
                .cosine = along.x() / length,
                .weight = along.x() * pillar.weight,
                .push = 0,
                .press = 0,
                .torque = 0,
                .pore_pressure = section_.pore_pressure(column, base.x(), base.y()),
                .strength = section_.soils()[static_cast<std::size_t>(soil)].strength->at(base.y())};
    const Point left{a.x(), column.ground(a.x())}, right{b.x(), column.ground(b.x())};
    add_water(section_, column, left, right, slice);
    add_loads(section_, left, right, slice);
    add_force({base.x(), pillar.centre}, {section_.horizontal() * slice.weight, 0}, slice);
    slices_.push_back(slice);
  }

  /// Water on upright steps of the ground, each with the slice that it stands on.
  bool add_steps(const SlipSurface& surface) {
    const auto& columns = section_.columns();
    for (std::size_t k = section_.column_of(surface.front().x()); k < columns.size(); ++k) {
      const double x = columns[k].from;
      if (x > surface.back().x() + tolerance_) break;
      if (x < surface.front().x() - tolerance_) continue;
      const bool is_first = k == 0 || columns[k - 1].strips.empty() || x <= surface.front().x() + tolerance_;
      add_step(k, is_first ? surface.front().y() : columns[k - 1].ground(x), x, surface);
    }
    return true;
  }

  void add_step(std::size_t k, double below, double x, const SlipSurface& surface) {
    const Column& right = section_.columns()[k];
    if (right.strips.empty() || x >= surface.back().x() - tolerance_) return;
    const double above = right.ground(x);
    if (std::abs(above - below) <= tolerance_) return;
    const bool rises = above > below;
    // Pressure is that of the free side, the lower ground's.
    const Column& wet = rises && k > 0 ? section_.columns()[k - 1] : right;
    const auto slice = std::find_if(slices_.begin(), slices_.end(), [&](const Slice& s) {
      return rises ? s.base.x() > x : s.base.x() + 0.5 * s.width >= x - tolerance_;
    });
    if (slice == slices_.end()) return;
    add_loads(section_, {x, below}, {x, above}, *slice);
    // Only what is wetted: pressure is linear below the level.
    const double level = wet.water_level(x);
    const double low = std::min(below, above), high = std::min(std::max(below, above), std::max(level, low));
    if (rises)
      add_water(section_, wet, {x, low}, {x, high}, *slice);
    else
      add_water(section_, wet, {x, high}, {x, low}, *slice);
  }

  const Section& section_;
  std::vector<Slice>& slices_;
  double tolerance_ = 0;
};

}  // namespace

void cut(const Section& section, const SlipSurface& surface, std::vector<Slice>& slices) {
  slices.clear();
  if (surface.size() < 2 || !Cutter(section, slices).cut(surface)) slices.clear();
}

}  // namespace porosph::limit_equilibrium
