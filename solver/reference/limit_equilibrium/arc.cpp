#include "solver/reference/limit_equilibrium/arc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace porosph::limit_equilibrium {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double steepest_entry = 88 * degree;  // of the surface at the crest
constexpr double steepest_exit = 70 * degree;   // at the toe, downwards
constexpr double smallest_span = 1e-3;

using Column = Section::Column;

/// Calls with each column between a and b and the part of it from x to x.
template <class Visit>
bool for_columns(const Section& section, const Point& a, const Point& b, const Visit& visit) {
  for (std::size_t k = section.column_of(a.x()); k < section.columns().size(); ++k) {
    const Column& c = section.columns()[k];
    const double from = std::max(c.from, a.x()), to = std::min(c.to, b.x());
    if (from >= b.x()) return true;
    if (to <= from) continue;
    if (c.strips.empty() || !visit(c, from, to)) return false;
  }
  return true;
}

bool is_below_ground(const Section& section, const Arc& arc) {
  const double tolerance = 1e-9 * (arc.to() - arc.from()).norm();
  return for_columns(section, arc.from(), arc.to(), [&](const Column& c, double from, double to) {
    return arc.y(from) <= c.ground(from) + tolerance && arc.y(to) <= c.ground(to) + tolerance;
  });
}

/// The arc is lowest over the floor's line where it is parallel to it.
bool is_above_floor(const Section& section, const Arc& arc) {
  const double tolerance = 1e-9 * (arc.to() - arc.from()).norm();
  const Point centre = arc.centre();
  const double radius = arc.radius();
  return for_columns(section, arc.from(), arc.to(), [&](const Column& c, double from, double to) {
    const double slope = std::atan2(c.lowest[1] - c.lowest[0], c.to - c.from);
    for (const double x : {from, to, std::clamp(centre.x() + radius * std::sin(slope), from, to)})
      if (arc.y(x) < c.floor(x) - tolerance) return false;
    return true;
  });
}

}  // namespace

Arc::Arc(const Point& a, const Point& b, double half) : a_(a), b_(b), half_(half) {
  const Point chord = b - a;
  centre_ = 0.5 * (a + b) + Point(-chord.y(), chord.x()) * (0.5 / std::tan(half));
  radius_ = 0.5 * chord.norm() / std::sin(half);
}

double Arc::y(double x) const {
  const double dx = x - centre_.x();
  return centre_.y() - std::sqrt(std::max(0.0, radius_ * radius_ - dx * dx));
}

SlipSurface Arc::points(const Section& section, int slices) const {
  std::vector<double> x;
  const double chord = std::atan2(b_.y() - a_.y(), b_.x() - a_.x());
  for (int i = 1; i < slices; ++i)
    x.push_back(centre_.x() + radius_ * std::sin(chord - half_ + 2 * half_ * i / slices));
  for_columns(section, a_, b_, [&](const Column&, double, double to) {
    if (to < b_.x()) x.push_back(to);
    return true;
  });
  std::sort(x.begin(), x.end());
  SlipSurface surface{a_};
  const double narrow = 1e-6 * (b_.x() - a_.x());
  for (const double at : x)
    if (at - surface.back().x() > narrow && b_.x() - at > narrow) surface.push_back({at, y(at)});
  surface.push_back(b_);
  return surface;
}

std::optional<Spans> possible_spans(const Section& section, const Point& a, const Point& b, bool keep_floor) {
  const double chord = std::atan2(b.y() - a.y(), b.x() - a.x());
  Spans spans{smallest_span, std::min(steepest_entry - chord, steepest_exit + chord)};
  if (spans.most <= spans.least) return std::nullopt;
  const auto fits_ground = [&](double half) { return is_below_ground(section, {a, b, half}); };
  const auto fits_floor = [&](double half) { return !keep_floor || is_above_floor(section, {a, b, half}); };
  if (!fits_ground(spans.most) || !fits_floor(spans.least)) return std::nullopt;
  const auto boundary = [](double inside, double outside, const auto& fits) {
    for (int i = 0; i < 24; ++i) {
      const double middle = 0.5 * (inside + outside);
      (fits(middle) ? inside : outside) = middle;
    }
    return inside;
  };
  if (!fits_ground(spans.least)) spans.least = boundary(spans.most, spans.least, fits_ground);
  if (!fits_floor(spans.most)) spans.most = boundary(spans.least, spans.most, fits_floor);
  if (spans.most < spans.least) return std::nullopt;
  return spans;
}

}  // namespace porosph::limit_equilibrium
