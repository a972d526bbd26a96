#include "render/scenery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "render/legend.hpp"
#include "solver/boundary/support.hpp"

namespace porosph::render {

namespace {

const Colour water_blue{20, 90, 190}, outline_grey{45, 45, 45};

template <typename Visit>
void for_each_ring(const std::vector<SoilOutline>& soils, const Visit& visit) {
  for (const SoilOutline& soil : soils) {
    visit(soil.polygon);
    for (const Polygon& hole : soil.holes) visit(hole);
  }
}

bool inside_ring(const Polygon& ring, Point point) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const bool crosses = (ring[i].y() > point.y()) != (ring[j].y() > point.y());
    if (!crosses) continue;
    const double t = (point.y() - ring[i].y()) / (ring[j].y() - ring[i].y());
    if (point.x() < ring[i].x() + t * (ring[j].x() - ring[i].x())) inside = !inside;
  }
  return inside;
}

std::vector<double> crossings(const std::vector<SoilOutline>& soils, double y, double x_from, double x_to) {
  std::vector<double> cuts = {x_from, x_to};
  for_each_ring(soils, [&](const Polygon& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      if ((ring[i].y() > y) == (ring[j].y() > y)) continue;
      const double x =
          ring[i].x() + (y - ring[i].y()) / (ring[j].y() - ring[i].y()) * (ring[j].x() - ring[i].x());
      if (x > x_from && x < x_to) cuts.push_back(x);
    }
  });
  std::ranges::sort(cuts);
  return cuts;
}

std::vector<Interval> intervals(const std::vector<SoilOutline>& soils, double y, double x_from, double x_to,
                                bool wanted_inside) {
  std::vector<Interval> found;
  const std::vector<double> cuts = crossings(soils, y, x_from, x_to);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (!(cuts[i + 1] > cuts[i])) continue;
    if (inside_soil(soils, {0.5 * (cuts[i] + cuts[i + 1]), y}) != wanted_inside) continue;
    if (!found.empty() && found.back().to == cuts[i])
      found.back().to = cuts[i + 1];
    else
      found.push_back({cuts[i], cuts[i + 1]});
  }
  return found;
}

std::vector<Pixel> closed(const Plot& plot, const Polygon& ring) {
  std::vector<Pixel> pixels;
  for (const Point& point : ring) pixels.push_back(plot.at(point.x(), point.y()));
  pixels.push_back(pixels.front());
  return pixels;
}

void draw_outlines(Canvas& canvas, const Plot& plot, const std::vector<SoilOutline>& soils) {
  for_each_ring(soils, [&](const Polygon& ring) {
    if (!ring.empty()) canvas.line(closed(plot, ring), {.colour = outline_grey, .width = 1.2});
  });
}

/// The engineer's sign for a free water surface: a triangle standing on it, shorter strokes beneath.
void draw_water_sign(Canvas& canvas, Pixel at) {
  constexpr double half = 7, height = 12;
  const std::vector<Pixel> triangle = {
      {at.x, at.y}, {at.x + half, at.y + height}, {at.x - half, at.y + height}, {at.x, at.y}};
  const Pen pen{.colour = water_blue, .width = 1.3};
  canvas.polygon(std::span(triangle).first(3), {.colour = white});
  canvas.line(triangle, pen);
  canvas.line({at.x - 6, at.y - 4}, {at.x + 6, at.y - 4}, pen);
  canvas.line({at.x - 3, at.y - 7}, {at.x + 3, at.y - 7}, pen);
}

void draw_water_level(Canvas& canvas, const Plot& plot, const std::vector<SoilOutline>& soils,
                      const WaterStretch& stretch) {
  const auto line = [&](const Interval& part, const Pen& pen) {
    canvas.line(plot.at(part.from, stretch.level), plot.at(part.to, stretch.level), pen);
  };
  for (const Interval& part : soil_intervals(soils, stretch.level, stretch.x_from, stretch.x_to)) {
    line(part, {.colour = white, .width = 2.6});
    line(part, {.colour = water_blue, .width = 1.3, .dashes = {6, 4}});
  }
  const auto open = free_intervals(soils, stretch.level, stretch.x_from, stretch.x_to);
  for (const Interval& part : open) {
    line(part, {.colour = water_blue, .width = 1.5});
    if (plot.at(part.to, 0).x - plot.at(part.from, 0).x < 24) continue;  // the sign would hide the line
    const double x =
        part.from + std::min(0.5, 60 / (plot.at(part.to, 0).x - plot.at(part.from, 0).x)) * part.length();
    draw_water_sign(canvas, plot.at(x, stretch.level));
  }
}

void draw_water_table(Canvas& canvas, const Plot& plot, const std::vector<Point>& table) {
  std::vector<Pixel> line;
  for (const Point& p : table) line.push_back(plot.at(p.x(), p.y()));
  canvas.line(line, {.colour = white, .width = 2.6});
  canvas.line(line, {.colour = water_blue, .width = 1.3, .dashes = {6, 4}});
}

struct DrawnWall {
  Pixel from, to;
  Pixel along, away;  ///< unit vectors; `away` points away from the soil
  double length;
  Pixel at(double s, double offset) const {
    return {from.x + s * along.x + offset * away.x, from.y + s * along.y + offset * away.y};
  }
};

/// Of a boundary that may reach beyond the soil.
bool soil_is_left(const std::vector<SoilOutline>& soils, const BoundaryCase& boundary) {
  constexpr int places = 64;
  const Point along = boundary.to - boundary.from, aside = 1e-3 * Point(-along.y(), along.x());
  int left = 0;
  for (int i = 0; i < places; ++i) {
    const Point place = boundary.from + (i + 0.5) / places * along;
    left += inside_soil(soils, place + aside) - inside_soil(soils, place - aside);
  }
  return left > 0;
}

/// The part of the line from `a` to `b` within `box`; both ends the same where there is none.
std::pair<Pixel, Pixel> cut(Pixel a, Pixel b, const Box& box) {
  double low = 0, high = 1;
  const auto limit = [&](double start, double change, double from, double to) {
    if (change == 0) {
      if (start < from || start > to) high = low;
      return;
    }
    const double t0 = (from - start) / change, t1 = (to - start) / change;
    low = std::max(low, std::min(t0, t1));
    high = std::min(high, std::max(t0, t1));
  };
  limit(a.x, b.x - a.x, box.x, box.right());
  limit(a.y, b.y - a.y, box.y, box.top());
  if (low >= high) return {a, a};
  const auto at = [&](double t) { return Pixel{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; };
  return {at(low), at(high)};
}

DrawnWall drawn_wall(const Plot& plot, const std::vector<SoilOutline>& soils, const BoundaryCase& boundary) {
  const auto [from, to] =
      cut(plot.at(boundary.from.x(), boundary.from.y()), plot.at(boundary.to.x(), boundary.to.y()), plot.box);
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  DrawnWall result{from, to, {(to.x - from.x) / length, (to.y - from.y) / length}, {}, length};
  const double side = soil_is_left(soils, boundary) ? -1 : 1;
  result.away = {-side * result.along.y, side * result.along.x};
  return result;
}

void draw_fixed(Canvas& canvas, const DrawnWall& wall) {
  constexpr double spacing = 9, depth = 8;
  canvas.line(wall.from, wall.to, {.colour = outline_grey, .width = 1.6});
  for (double s = 0.5 * spacing; s < wall.length; s += spacing)
    canvas.line(wall.at(s, 0), wall.at(std::max(0., s - depth), depth), {.colour = outline_grey, .width = 1});
}

/// Hatched like a fixed one, behind a gap in which the soil slides.
void draw_friction(Canvas& canvas, const DrawnWall& wall) {
  constexpr double gap = 3;
  DrawnWall behind = wall;
  behind.from = wall.at(0, gap), behind.to = wall.at(wall.length, gap);
  canvas.line(wall.from, wall.to, {.colour = outline_grey, .width = 1});
  draw_fixed(canvas, behind);
}

void draw_rollers(Canvas& canvas, const DrawnWall& wall) {
  constexpr double radius = 3.5, spacing = 30;
  const int count = std::max(2, static_cast<int>(wall.length / spacing));
  for (int i = 0; i < count; ++i)
    canvas.disc(wall.at((i + 0.5) * wall.length / count, radius + 1), radius, {.colour = white},
                {.colour = outline_grey});
  const double offset = 2 * radius + 2;
  canvas.line(wall.at(0, offset), wall.at(wall.length, offset), {.colour = outline_grey});
}

/// A dashed line: the soil continues.
void draw_periodic(Canvas& canvas, const DrawnWall& wall) {
  const std::vector<Pixel> line = {wall.from, wall.to};
  canvas.line(line, {.colour = outline_grey, .width = 1.6, .dashes = {7, 4}});
}

void draw_support(Canvas& canvas, const Plot& plot, const std::vector<SoilOutline>& soils,
                  const BoundaryCase& boundary) {
  const DrawnWall wall = drawn_wall(plot, soils, boundary);
  if (!(wall.length > 0)) return;
  if (support_of(boundary.kind).carries_shear())
    draw_fixed(canvas, wall);
  else if (boundary.kind == BoundaryKind::friction)
    draw_friction(canvas, wall);
  else if (boundary.kind == BoundaryKind::periodic)
    draw_periodic(canvas, wall);
  else
    draw_rollers(canvas, wall);
}

constexpr double probe_radius = 4;

/// Whether the line from a to b comes into the box.
bool crosses(const Box& box, Pixel a, Pixel b) {
  const auto [from, to] = cut(a, b, box);
  return from.x != to.x || from.y != to.y;
}

/// How much a name in this box would hide: outlines, water levels, other probes and names.
int hidden_by(const Box& box, const Plot& plot, const Scenery& scenery, const std::vector<Box>& taken) {
  int hidden = 0;
  for_each_ring(scenery.soils, [&](const Polygon& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point &p = ring[i], &q = ring[(i + 1) % ring.size()];
      hidden += crosses(box, plot.at(p.x(), p.y()), plot.at(q.x(), q.y()));
    }
  });
  for (const WaterStretch& stretch : scenery.water) {
    const double y = plot.at(0, stretch.level).y;
    hidden += crosses(box, {std::max(plot.box.x, plot.at(stretch.x_from, 0).x), y},
                      {std::min(plot.box.right(), plot.at(stretch.x_to, 0).x), y});
  }
  for (const Box& other : taken)
    hidden +=
        2 * (box.x < other.right() && other.x < box.right() && box.y < other.top() && other.y < box.top());
  const bool outside = box.x < plot.box.x || box.right() > plot.box.right() || box.y < plot.box.y ||
                       box.top() > plot.box.top();
  return hidden + (outside ? 100 : 0);
}

/// Beside, above or below the probe: where the name hides least.
Box name_place(Pixel at, Pixel extent, const Plot& plot, const Scenery& scenery,
               const std::vector<Box>& taken) {
  constexpr double gap = probe_radius + 4;
  const double width = extent.x + 4, height = 1.25 * title_text;
  Box best;
  int least = std::numeric_limits<int>::max();
  for (const Pixel corner :
       {Pixel{at.x + gap, at.y - 0.5 * height}, Pixel{at.x - gap - width, at.y - 0.5 * height},
        Pixel{at.x - 0.5 * width, at.y - gap - height}, Pixel{at.x - 0.5 * width, at.y + gap},
        Pixel{at.x + gap, at.y - gap - height}, Pixel{at.x - gap - width, at.y - gap - height},
        Pixel{at.x + gap, at.y + gap}, Pixel{at.x - gap - width, at.y + gap}}) {
    const Box box{corner.x, corner.y, width, height};
    const int hidden = hidden_by(box, plot, scenery, taken);
    if (hidden < least) best = box, least = hidden;
  }
  return best;
}

struct PlacedProbe {
  Pixel at;
  double text_size = 0;
  Box name;  ///< of no width where it has none
};

std::vector<PlacedProbe> placed_probes(const Plot& plot, const Scenery& scenery) {
  std::vector<Box> taken;
  for (const ProbeCase& probe : scenery.probes) {
    const Pixel at = plot.at(probe.position.x(), probe.position.y());
    taken.push_back({at.x - probe_radius, at.y - probe_radius, 2 * probe_radius, 2 * probe_radius});
  }
  std::vector<PlacedProbe> placed;
  for (const ProbeCase& probe : scenery.probes) {
    PlacedProbe p{.at = plot.at(probe.position.x(), probe.position.y()), .text_size = 0, .name = {}};
    if (!probe.name.empty()) {
      p.text_size = fitting_size(probe.name, title_text, 0.5 * plot.box.width);
      p.name = name_place(p.at, text_extent(probe.name, p.text_size), plot, scenery, taken);
      taken.push_back(p.name);
    }
    placed.push_back(p);
  }
  return placed;
}

void draw_probes(Canvas& canvas, const Plot& plot, const Scenery& scenery) {
  const std::vector<PlacedProbe> placed = placed_probes(plot, scenery);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const PlacedProbe& p = placed[i];
    if (p.name.width > 0)
      canvas.text({p.name.x + 2, p.name.centre().y}, scenery.probes[i].name,
                  {.size = p.text_size, .horizontal = Align::low, .halo = true});
    canvas.disc(p.at, probe_radius, {.colour = white}, {.colour = black, .width = 1.4});
  }
}

/// Arrows that end on the surface, in the direction of the force, as long as their share of the largest.
void draw_load(Canvas& canvas, const Plot& plot, const std::vector<SoilOutline>& soils,
               const LoadCase& load) {
  constexpr double longest = 26, spacing = 16, head = 5;
  const Pixel from = plot.at(load.from.x(), load.from.y()), to = plot.at(load.to.x(), load.to.y());
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const Point way = load.to - load.from;
  Point normal = Point(way.y(), -way.x()).normalized();
  if (inside_soil(soils, (load.from + load.to) / 2 + 1e-3 * way.norm() * normal)) normal = -normal;
  const auto force = [&](double t) -> Point {
    return load.traction + t * (load.traction_to - load.traction) -
           (load.pressure + t * (load.pressure_to - load.pressure)) * normal;
  };
  const double largest = std::max(force(0).norm(), force(1).norm());
  const Pen pen{.colour = {170, 40, 20}, .width = 1.4};
  const int count = std::max(2, static_cast<int>(length / spacing));
  for (int i = 0; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    const Point f = force(t);
    if (!(f.norm() > 0.02 * largest)) continue;
    const Point along = f.normalized(), aside(-along.y(), along.x());
    const double size = longest * f.norm() / largest;
    Pixel tip{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
    if (along.dot(normal) > 0) tip = {tip.x + size * along.x(), tip.y + size * along.y()};  // pulls
    canvas.line({tip.x - size * along.x(), tip.y - size * along.y()}, tip, pen);
    for (const double side : {-0.5, 0.5})
      canvas.line(
          {tip.x - head * (along.x() + side * aside.x()), tip.y - head * (along.y() + side * aside.y())}, tip,
          pen);
  }
}

/// A bar on the outside of the soil's surface, with a thick line against the soil where it is rough.
void draw_footing(Canvas& canvas, const Plot& plot, const std::vector<SoilOutline>& soils,
                  const FootingCase& footing) {
  constexpr double thickness = 9;
  const Point way = footing.to - footing.from;
  Point normal = Point(way.y(), -way.x()).normalized();
  if (inside_soil(soils, (footing.from + footing.to) / 2 + 1e-3 * way.norm() * normal)) normal = -normal;
  const Pixel from = plot.at(footing.from.x(), footing.from.y()),
              to = plot.at(footing.to.x(), footing.to.y());
  const auto outside = [&](Pixel p) {
    return Pixel{p.x + thickness * normal.x(), p.y + thickness * normal.y()};
  };
  const std::array<Pixel, 5> corners{from, to, outside(to), outside(from), from};
  canvas.polygon(std::span(corners).first(4), {.colour = {150, 150, 155}});
  canvas.line(corners, {.colour = black, .width = 1.2});
  if (footing.rough) canvas.line(from, to, {.colour = black, .width = 3});
}

/// A thick line, and its moment diagram on the side that is stretched, with the largest value at its place.
void draw_sheet(Canvas& canvas, const Plot& plot, const DrawnSheet& sheet) {
  constexpr double longest = 45;  // of the diagram [pixels]
  const Colour red{176, 24, 40};
  std::vector<Pixel> line, ends;
  for (const Point& p : sheet.points) line.push_back(plot.at(p.x(), p.y()));
  const auto size = [](double moment) { return std::abs(moment); };
  const auto largest = std::ranges::max_element(sheet.moments, {}, size);
  if (largest != sheet.moments.end() && *largest != 0) {
    const Point way{line.back().x - line.front().x, line.back().y - line.front().y};
    const Point right = Point(way.y(), -way.x()).normalized();
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Point off = longest * sheet.moments[i] / std::abs(*largest) * right;
      ends.push_back({line[i].x + off.x(), line[i].y + off.y()});
    }
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      canvas.polygon(std::array{line[i], line[i + 1], ends[i + 1], ends[i]},
                     {.colour = red, .opacity = 0.25});
    canvas.line(ends, {.colour = red, .width = 1.4});
    const Pixel tip = ends[static_cast<std::size_t>(largest - sheet.moments.begin())];
    const bool rightwards = right.x() * *largest >= 0;
    canvas.text(
        {tip.x + (rightwards ? 5 : -5), tip.y}, fmt::format("{:.3g} kNm/m", std::abs(*largest) / 1e3),
        {.size = 12, .colour = red, .horizontal = rightwards ? Align::low : Align::high, .halo = true});
  }
  canvas.line(line, {.colour = white, .width = 5.5});
  canvas.line(line, {.colour = black, .width = 3.5});
}

std::vector<Pixel> pixels_of(const Plot& plot, const std::vector<Point>& points) {
  std::vector<Pixel> pixels;
  for (const Point& p : points) pixels.push_back(plot.at(p.x(), p.y()));
  return pixels;
}

void draw_lines(Canvas& canvas, const Plot& plot, const Scenery& scenery) {
  std::vector<LegendEntry> entries;
  std::vector<std::vector<Pixel>> drawn;
  for_each_ring(scenery.soils, [&](const Polygon& ring) {
    if (!ring.empty()) drawn.push_back(closed(plot, ring));
  });
  for (const SceneryLine& line : scenery.lines) {
    const Pen pen{.colour = line.colour, .width = 2.2};
    drawn.push_back(pixels_of(plot, line.points));
    canvas.line(drawn.back(), {.colour = white, .width = 4.4});
    canvas.line(drawn.back(), pen);
    entries.push_back({line.label, pen});
  }
  if (const auto place = free_corner(plot.box, legend_extent(entries), drawn); place && !entries.empty())
    draw_legend(canvas, *place, entries);
}

}  // namespace

bool inside_soil(const std::vector<SoilOutline>& soils, Point point) {
  return std::ranges::any_of(soils, [&](const SoilOutline& soil) {
    const auto contains = [&](const Polygon& ring) { return !ring.empty() && inside_ring(ring, point); };
    return contains(soil.polygon) && std::ranges::none_of(soil.holes, contains);
  });
}

std::vector<Interval> soil_intervals(const std::vector<SoilOutline>& soils, double y, double x_from,
                                     double x_to) {
  return intervals(soils, y, x_from, x_to, true);
}

std::vector<Interval> free_intervals(const std::vector<SoilOutline>& soils, double y, double x_from,
                                     double x_to) {
  return intervals(soils, y, x_from, x_to, false);
}

std::vector<Box> probe_boxes(const Plot& plot, const Scenery& scenery) {
  std::vector<Box> boxes;
  for (const PlacedProbe& p : placed_probes(plot, scenery)) {
    boxes.push_back({p.at.x - probe_radius, p.at.y - probe_radius, 2 * probe_radius, 2 * probe_radius});
    if (p.name.width > 0) boxes.push_back(p.name);
  }
  return boxes;
}

void draw_scenery(Canvas& canvas, const Plot& plot, const Scenery& scenery, double x_from, double x_to) {
  draw_outlines(canvas, plot, scenery.soils);
  for (WaterStretch stretch : scenery.water) {
    stretch.x_from = std::max(stretch.x_from, x_from);
    stretch.x_to = std::min(stretch.x_to, x_to);
    if (stretch.x_from < stretch.x_to) draw_water_level(canvas, plot, scenery.soils, stretch);
  }
  for (const auto& table : scenery.water_table) draw_water_table(canvas, plot, table);
  for (const BoundaryCase& boundary : scenery.boundaries) draw_support(canvas, plot, scenery.soils, boundary);
  for (const LoadCase& load : scenery.loads) draw_load(canvas, plot, scenery.soils, load);
  for (const FootingCase& footing : scenery.footings) draw_footing(canvas, plot, scenery.soils, footing);
  for (const DrawnSheet& sheet : scenery.sheets) draw_sheet(canvas, plot, sheet);
  draw_probes(canvas, plot, scenery);
  draw_lines(canvas, plot, scenery);
}

}  // namespace porosph::render
