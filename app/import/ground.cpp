#include "app/import/ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/import/drawn_water.hpp"
#include "app/import/meeting_outlines.hpp"
#include "solver/case/outline_edges.hpp"
#include "solver/space/place_text.hpp"

namespace porosph::drawn {
namespace {

constexpr std::size_t most_points = 20000;  // of a drawing

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// Fit for a name in a case: letters, digits, '_' and '-'.
std::string name_of(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (fits)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "unnamed" : name.substr(0, 32);
}

/// What a text of several lines begins with: the lines below the name are mostly its properties.
std::string first_line(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_first_of("\r\n", begin) - begin);
}

/// The name, numbered where it was given before.
std::string unlike_others(const std::string& name, std::set<std::string>& given) {
  for (int i = 1;; ++i) {
    const std::string tried = i == 1 ? name : fmt::format("{}_{}", name, i);
    if (given.insert(tried).second) return tried;
  }
}

/// Gathers what is drawn, in metres, and notes what is not taken.
class Gatherer {
 public:
  Gatherer(const Drawing& drawing, const Options& options) : options_(options) {
    ground_.notes = drawing.left_out;
    for (std::string& note : ground_.notes) note += ": left out";
    for (const Shape& shape : drawing.shapes) add(shape);
    place_probes();
    for (const auto& [what, count] : left_out_) ground_.notes.push_back(fmt::format("{} x {}", count, what));
  }

  Linework soils;                    ///< as drawn
  std::vector<Polygon> water_lines;  ///< open ones
  Ground finished() && { return std::move(ground_); }

 private:
  Polygon in_metres(Polygon ring) const {
    for (Point& p : ring) p *= options_.metres;
    return ring;
  }

  bool is_closed(const Polygon& line) const {
    return line.size() > 3 && (line.front() - line.back()).norm() <= options_.snap;
  }

  void leave_out(const Shape& shape, const std::string& why) {
    ++left_out_[fmt::format("{} on layer '{}': left out{}",
                            shape.kind == ShapeKind::point  ? shape.text.empty() ? "point" : "text"
                            : shape.kind == ShapeKind::area ? "area"
                                                            : "line",
                            shape.layer, why)];
  }

  void add(const Shape& shape) {
    if (shape.rings.empty() || shape.rings[0].empty()) return;
    switch (role_of(shape.layer, options_)) {
      case Role::soil:
        return add_soil(shape);
      case Role::water:
        return add_water(shape);
      case Role::probe:
        return add_probe(shape);
      case Role::roller:
      case Role::fixed:
        return add_supports(shape);
      case Role::nothing:
        return;
    }
  }

  void add_soil(const Shape& shape) {
    const Polygon points = in_metres(shape.rings[0]);
    if (shape.kind == ShapeKind::point) {
      if (shape.text.empty()) return leave_out(shape, "");
      soils.texts.push_back({first_line(shape.text), shape.layer, points[0]});
    } else if (shape.kind == ShapeKind::line && !is_closed(points)) {
      soils.lines.push_back({shape.layer, points});
    } else {
      Region region{shape.layer, {}};
      for (const Polygon& ring : shape.rings) region.rings.push_back(in_metres(ring));
      soils.closed.push_back(std::move(region));
    }
  }

  void add_water(const Shape& shape) {
    if (shape.kind == ShapeKind::point) return leave_out(shape, "");
    const Polygon line = in_metres(shape.rings[0]);
    if (shape.kind == ShapeKind::area || is_closed(line)) {
      const auto [left, right] = std::ranges::minmax_element(line, {}, [](const Point& p) { return p.x(); });
      const auto top = std::ranges::max_element(line, {}, [](const Point& p) { return p.y(); });
      ground_.water.push_back({left->x(), right->x(), top->y()});
    } else {
      water_lines.push_back(line);
    }
  }

  void add_probe(const Shape& shape) {
    if (shape.kind != ShapeKind::point && shape.kind != ShapeKind::rows) return leave_out(shape, "");
    for (const Point& p : in_metres(shape.rings[0]))
      (shape.text.empty() ? points_ : texts_).push_back({shape.text.empty() ? shape.layer : shape.text, p});
  }

  /// Texts beside points name the nearest of them; texts alone are probes themselves.
  void place_probes() {
    std::vector<ProbeCase> named;
    if (points_.empty()) std::swap(named, texts_);
    for (const ProbeCase& text : texts_) {
      const auto nearest = std::ranges::min_element(
          points_, {}, [&](const ProbeCase& p) { return (p.position - text.position).norm(); });
      if (nearest == points_.end()) break;
      named.push_back({text.name, nearest->position});
      points_.erase(nearest);
    }
    named.insert(named.end(), points_.begin(), points_.end());
    for (const ProbeCase& probe : named)
      ground_.probes.push_back({unlike_others(name_of(probe.name), probe_names_), probe.position});
  }

  void add_supports(const Shape& shape) {
    if (shape.kind == ShapeKind::point) return leave_out(shape, "");
    const BoundaryKind kind =
        role_of(shape.layer, options_) == Role::roller ? BoundaryKind::roller : BoundaryKind::fixed;
    for (const Polygon& ring : shape.rings) {
      const Polygon line = in_metres(ring);
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if ((line[i] - line[i + 1]).norm() > options_.snap)
          ground_.supports.push_back({kind, line[i], line[i + 1]});
    }
  }

  const Options& options_;
  Ground ground_;
  std::map<std::string, int> left_out_;
  std::set<std::string> probe_names_;
  std::vector<ProbeCase> points_, texts_;  // of probes, as drawn
};

bool is_in_soil(const Point& p, const std::vector<SoilCase>& soils) {
  return std::ranges::any_of(soils, [&](const SoilCase& soil) {
    return is_inside(p, soil.polygon) &&
           std::ranges::none_of(soil.holes, [&](const Polygon& hole) { return is_inside(p, hole); });
  });
}

bool goes_on(const Stretch& first, const Stretch& next) {
  if (first.side != next.side || first.to != next.from) return false;
  const Point before = first.to - first.from, after = next.to - next.from;
  const double turn = std::abs(before.x() * after.y() - before.y() * after.x());
  return turn <= 1e-9 * before.norm() * after.norm() && before.dot(after) > 0;
}

/// Joins stretches that continue in one line, whatever soils they are of.
void join(std::vector<Stretch>& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i)
    for (std::size_t j = 0; j < outline.size(); ++j) {
      if (i == j || !goes_on(outline[i], outline[j])) continue;
      outline[i].to = outline[j].to;
      outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(j));
      return join(outline);
    }
}

/// The outline of all soils: edges that one soil has alone.
std::vector<Stretch> outline_of(const std::vector<SoilCase>& soils, double snap) {
  const std::vector<OutlineEdge> edges = outline_edges(soils);
  double left = never, right = -never;
  for (const OutlineEdge& e : edges) left = std::min(left, e.a.x()), right = std::max(right, e.a.x());
  const auto side_of = [&](const Point& a, const Point& b) {
    const bool upright = std::abs(a.x() - b.x()) <= snap;
    if (upright && (std::abs(a.x() - left) <= snap || std::abs(a.x() - right) <= snap)) return Side::flank;
    const bool looks_down = b.x() - a.x() > 0.5 * (b - a).norm();  // soil on the left
    const Point below = (a + b) / 2 - Point(0, 10 * snap);
    return looks_down && !is_in_soil(below, soils) ? Side::base : Side::surface;
  };
  std::vector<Stretch> outline;
  for (const OutlineEdge& e : edges)
    if (is_free(e, edges, {}, snap)) outline.push_back({side_of(e.a, e.b), e.a, e.b});
  join(outline);
  return outline;
}

void require_known_layers(const Drawing& drawing, const Options& options) {
  for (const auto& given : options.roles) {
    const std::string& layer = given.first;
    if (std::ranges::any_of(drawing.shapes, [&](const Shape& s) { return s.layer == layer; })) continue;
    std::set<std::string> there;
    for (const Shape& shape : drawing.shapes) there.insert(shape.layer);
    throw DrawingError(fmt::format("has no layer '{}'; it has '{}'", layer, fmt::join(there, "', '")));
  }
}

/// Soils as closed shapes, or as what lines enclose; their names fit a case, each one once.
std::vector<Region> regions_of(Linework& drawn, const Options& options, std::vector<std::string>& notes) {
  std::vector<Region> regions;
  if (drawn.lines.empty() && drawn.told.empty()) {
    std::map<std::string, int> texts;  // by layer
    for (const Label& text : drawn.texts) ++texts[text.layer];
    for (const auto& [layer, count] : texts)
      notes.push_back(fmt::format("{} x text on layer '{}': left out", count, layer));
    regions = std::move(drawn.closed);
  } else {
    NamedRegions named = regions_of_lines(drawn, options.snap, options.reader);
    notes.insert(notes.end(), named.notes.begin(), named.notes.end());
    regions = std::move(named.regions);
  }
  std::set<std::string> names;
  for (Region& region : regions) region.name = unlike_others(name_of(region.name), names);
  return regions;
}

}  // namespace

Role role_of(const std::string& layer, const Options& options) {
  if (const auto given = options.roles.find(layer); given != options.roles.end()) return given->second;
  const std::string name = lower(layer);
  for (const auto& [word, role] : {std::pair{"water", Role::water},
                                   {"probe", Role::probe},
                                   {"roller", Role::roller},
                                   {"fixed", Role::fixed}})
    if (name.starts_with(word)) return role;
  return Role::soil;
}

Ground ground_of(const Drawing& drawing, const Options& options) {
  require_known_layers(drawing, options);
  std::size_t points = 0;
  for (const Shape& shape : drawing.shapes)
    for (const Polygon& ring : shape.rings) points += ring.size();
  if (points > most_points)
    throw DrawingError(fmt::format("has {} points; at most {} are taken", points, most_points));

  Gatherer gatherer(drawing, options);
  Linework drawn = std::move(gatherer.soils);
  const std::vector<Polygon> water_lines = std::move(gatherer.water_lines);
  Ground ground = std::move(gatherer).finished();
  drawn.told = options.names;
  std::vector<Region> regions = regions_of(drawn, options, ground.notes);
  for (const std::string& note : make_outlines_meet(regions, options.snap)) ground.notes.push_back(note);
  if (regions.empty())
    throw DrawingError(fmt::format("has no shape that could be a soil{}{}", ground.notes.empty() ? "" : ": ",
                                   fmt::join(ground.notes, "; ")));
  for (Region& region : regions) {
    SoilCase soil;
    soil.name = region.name;
    soil.polygon = region.rings.front();
    soil.holes.assign(region.rings.begin() + 1, region.rings.end());
    ground.soils.push_back(std::move(soil));
  }
  ground.outline = outline_of(ground.soils, options.snap);
  add_water_lines(water_lines, options.snap, ground);
  require_something_drives(ground);
  std::erase_if(ground.probes, [&](const ProbeCase& probe) {
    const bool outside = !is_in_soil(probe.position, ground.soils);
    if (outside)
      ground.notes.push_back(fmt::format("probe '{}' at {} m: left out, as it is not in a soil", probe.name,
                                         place_text(probe.position)));
    return outside;
  });
  return ground;
}

}  // namespace porosph::drawn
