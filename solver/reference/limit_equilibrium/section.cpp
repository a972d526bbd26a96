#include "solver/reference/limit_equilibrium/section.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace porosph::limit_equilibrium {
namespace {

struct Edge {
  Point left, right;
  double y(double x) const {
    return left.y() + (right.y() - left.y()) * (x - left.x()) / (right.x() - left.x());
  }
};

/// Edges of all outlines that are not upright.
std::vector<Edge> edges_of(const SectionSoil& soil) {
  std::vector<Edge> edges;
  for (const Polygon& outline : soil.outlines)
    for (std::size_t i = 0; i < outline.size(); ++i) {
      Point a = outline[i], b = outline[(i + 1) % outline.size()];
      if (a.x() > b.x()) std::swap(a, b);
      if (a.x() < b.x()) edges.push_back({a, b});
    }
  return edges;
}

/// x where an edge meets a piece of the water's surface.
std::optional<double> crossing(const Edge& edge, const WaterPiece& water) {
  const Edge surface{water.from, water.to};
  const double from = std::max(edge.left.x(), surface.left.x());
  const double to = std::min(edge.right.x(), surface.right.x());
  if (from >= to) return std::nullopt;
  const double at_from = edge.y(from) - surface.y(from), at_to = edge.y(to) - surface.y(to);
  if (at_from * at_to >= 0) return std::nullopt;
  return from + (to - from) * at_from / (at_from - at_to);
}

}  // namespace

int Section::Column::soil_at(double x, double y) const {
  for (const Strip& s : strips)
    if (y >= at(s.bottom, x) && y <= at(s.top, x)) return s.soil;
  return nothing;
}

Section::Section(std::vector<SectionSoil> soils, std::vector<WaterPiece> water, double water_unit_weight,
                 std::vector<GroundLoad> loads, double horizontal, FreeEnds free)
    : soils_(std::move(soils)),
      water_(std::move(water)),
      water_unit_weight_(water_unit_weight),
      loads_(std::move(loads)),
      horizontal_(horizontal),
      free_(free) {
  for (const SectionSoil& soil : soils_)
    if (!(soil.unit_weight_saturated > 0 && soil.unit_weight_unsaturated > 0))
      throw std::invalid_argument("limit equilibrium: unit weights must be > 0 N/m3");
  const std::vector<double> x = corners();
  smallest_ = x.empty() ? 0 : 1e-9 * (x.back() - x.front());
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] - x[i - 1] > smallest_) columns_.push_back(column_between(x[i - 1], x[i]));
  trace_ground();
}

Section Section::mirrored() const {
  std::vector<SectionSoil> soils = soils_;
  for (SectionSoil& soil : soils)
    for (Polygon& outline : soil.outlines)
      for (Point& p : outline) p.x() = -p.x();
  std::vector<WaterPiece> water = water_;
  for (WaterPiece& piece : water) {
    std::swap(piece.from, piece.to);
    piece.from.x() = -piece.from.x(), piece.to.x() = -piece.to.x();
  }
  std::vector<GroundLoad> loads = loads_;
  for (GroundLoad& load : loads)
    for (Point* p : {&load.from, &load.to, &load.traction_from, &load.traction_to}) p->x() = -p->x();
  return {std::move(soils), std::move(water), water_unit_weight_,
          std::move(loads), -horizontal_,     {free_.right, free_.left}};
}

std::vector<double> Section::corners() const {
  std::vector<double> x;
  double left = never, right = -never;
  for (const SectionSoil& soil : soils_) {
    for (const Polygon& outline : soil.outlines)
      for (const Point& p : outline) x.push_back(p.x());
    for (const Edge& edge : edges_of(soil))
      for (const WaterPiece& piece : water_)
        if (const auto at = crossing(edge, piece)) x.push_back(*at);
  }
  for (const double at : x) left = std::min(left, at), right = std::max(right, at);
  for (const WaterPiece& piece : water_)
    for (const double at : {piece.from.x(), piece.to.x()})
      if (at > left && at < right) x.push_back(at);
  for (const GroundLoad& load : loads_) x.insert(x.end(), {load.from.x(), load.to.x()});
  std::sort(x.begin(), x.end());
  const double same = x.empty() ? 0 : 1e-9 * (x.back() - x.front());
  x.erase(std::unique(x.begin(), x.end(), [same](double a, double b) { return b - a <= same; }), x.end());
  return x;
}

Section::Column Section::column_between(double from, double to) const {
  const double middle = 0.5 * (from + to);
  std::vector<Strip> strips;
  for (std::size_t i = 0; i < soils_.size(); ++i) {
    std::vector<Edge> across;
    for (const Edge& edge : edges_of(soils_[i]))
      if (edge.left.x() < middle && edge.right.x() > middle) across.push_back(edge);
    std::sort(across.begin(), across.end(),
              [middle](const Edge& a, const Edge& b) { return a.y(middle) < b.y(middle); });
    for (std::size_t k = 0; k + 1 < across.size(); k += 2)
      strips.push_back({{across[k].y(from), across[k].y(to)},
                        {across[k + 1].y(from), across[k + 1].y(to)},
                        static_cast<int>(i)});
  }
  const auto middle_of = [](const double(&y)[2]) { return 0.5 * (y[0] + y[1]); };
  std::sort(strips.begin(), strips.end(),
            [&](const Strip& a, const Strip& b) { return middle_of(a.bottom) < middle_of(b.bottom); });
  Column column{from, to, {}, {0, 0}, {-never, -never}};
  // Nothing slides below a hole.
  std::size_t first = strips.empty() ? 0 : strips.size() - 1;
  while (first > 0 && middle_of(strips[first].bottom) - middle_of(strips[first - 1].top) <= smallest_)
    --first;
  column.strips.assign(strips.begin() + static_cast<std::ptrdiff_t>(first), strips.end());
  const auto holds = [&](const Strip& s) { return !soils_[static_cast<std::size_t>(s.soil)].strength; };
  const auto held = std::find_if(column.strips.rbegin(), column.strips.rend(), holds);
  for (const int end : {0, 1})
    if (!column.strips.empty())
      column.lowest[end] = held == column.strips.rend() ? column.strips.front().bottom[end] : held->top[end];
  for (const WaterPiece& piece : water_)
    if (piece.from.x() < middle && piece.to.x() > middle) {
      const Edge surface{piece.from, piece.to};
      column.water[0] = surface.y(from), column.water[1] = surface.y(to);
      break;
    }
  return column;
}

std::size_t Section::column_of(double x) const {
  const auto right_of =
      std::find_if(columns_.begin(), columns_.end(), [x](const Column& c) { return c.to >= x; });
  if (right_of == columns_.end() || right_of->from > x) return columns_.size();
  return static_cast<std::size_t>(right_of - columns_.begin());
}

Section::Pillar Section::pillar_above(const Column& column, double x, double y) const {
  const double level = column.water_level(x);
  Pillar pillar;
  double moment = 0;
  const auto add = [&](double bottom, double top, double unit_weight) {
    const double weight = (top - bottom) * unit_weight;
    pillar.weight += weight, moment += weight * 0.5 * (bottom + top);
  };
  for (const Strip& s : column.strips) {
    const double bottom = std::max(y, column.at(s.bottom, x)), top = column.at(s.top, x);
    if (top <= bottom) continue;
    const SectionSoil& soil = soils_[static_cast<std::size_t>(s.soil)];
    const double wet = std::clamp(level, bottom, top);
    add(bottom, wet, soil.unit_weight_saturated), add(wet, top, soil.unit_weight_unsaturated);
  }
  pillar.centre = pillar.weight > 0 ? moment / pillar.weight : y;
  return pillar;
}

double Section::pore_pressure(const Column& column, double x, double y) const {
  return water_unit_weight_ * std::max(0.0, column.water_level(x) - y);
}

Point Section::traction_at(const Point& place) const {
  Point sum = Point::Zero();
  for (const GroundLoad& load : loads_) {
    const Point way = load.to - load.from;
    const double t = (place - load.from).dot(way) / way.squaredNorm();
    const bool on_it = t >= 0 && t <= 1 && (place - load.from - t * way).norm() <= 1e3 * smallest_;
    if (on_it) sum += load.traction_from + t * (load.traction_to - load.traction_from);
  }
  return sum;
}

void Section::trace_ground() {
  bool open = false;
  for (const Column& c : columns_) {
    if (c.strips.empty()) {
      open = false;
      continue;
    }
    if (!open) grounds_.emplace_back();
    Polygon& ground = grounds_.back();
    const Point left{c.from, c.ground(c.from)}, right{c.to, c.ground(c.to)};
    if (!open || (ground.back() - left).norm() > smallest_) ground.push_back(left);
    ground.push_back(right);
    open = true;
  }
  if (columns_.empty() || columns_.front().strips.empty() || columns_.back().strips.empty()) return;
  const Column &first = columns_.front(), &last = columns_.back();
  const Point left{first.from, first.floor(first.from)}, right{last.to, last.floor(last.to)};
  const auto below = [&](const Point& end, const Point& ground) { return ground.y() - end.y() > smallest_; };
  if (free_.left && below(left, grounds_.front().front()))
    grounds_.front().insert(grounds_.front().begin(), left);
  if (free_.right && below(right, grounds_.back().back())) grounds_.back().push_back(right);
}

}  // namespace porosph::limit_equilibrium
