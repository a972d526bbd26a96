#include "app/import/regions_of_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "solver/space/place_text.hpp"

namespace porosph::drawn {
namespace {

constexpr std::size_t most_named = 5;  // gaps in one message

std::string text_of(const Label& label) {
  return fmt::format("'{}' at {}", label.text, place_text(label.at));
}

bool is_in(const Point& p, const std::vector<Polygon>& rings) {
  return is_inside(p, rings[0]) && std::none_of(rings.begin() + 1, rings.end(),
                                                [&](const Polygon& hole) { return is_inside(p, hole); });
}

double ring_area(const Polygon& ring) {
  double twice = 0;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    twice += ring[j].x() * ring[i].y() - ring[j].y() * ring[i].x();
  return std::abs(twice) / 2;
}

double area_of(const std::vector<Polygon>& rings) {
  double area = ring_area(rings[0]);
  for (std::size_t k = 1; k < rings.size(); ++k) area -= ring_area(rings[k]);
  return area;
}

/// About how wide a long region is [m].
double width_of(const std::vector<Polygon>& rings) {
  double length = 0;
  for (const Polygon& ring : rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      length += (ring[i] - ring[j]).norm();
  return 2 * area_of(rings) / length;
}

/// With two digits.
double a_little_above(double x) {
  const double digit = std::pow(10, std::floor(std::log10(x)) - 1);
  return (std::floor(x / digit) + 1) * digit;
}

/// A point well inside: the middle of the widest stretch at one of some heights.
Point point_in(const std::vector<Polygon>& rings) {
  const auto [low, high] = std::ranges::minmax_element(rings[0], {}, [](const Point& p) { return p.y(); });
  Point best = rings[0][0];
  double widest = 0;
  for (const int k : {8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15}) {
    const double y = low->y() + (high->y() - low->y()) * (k + 0.0137) / 16;
    std::vector<double> crossed;
    for (const Polygon& ring : rings)
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Point &a = ring[i], &b = ring[j];
        if ((a.y() > y) != (b.y() > y))
          crossed.push_back(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
      }
    std::ranges::sort(crossed);
    for (std::size_t i = 0; i + 1 < crossed.size(); i += 2)
      if (crossed[i + 1] - crossed[i] > 1.001 * widest) {
        widest = crossed[i + 1] - crossed[i];
        best = {(crossed[i] + crossed[i + 1]) / 2, y};
      }
  }
  return best;
}

class Namer {
 public:
  Namer(const Linework& drawn, double snap, const std::filesystem::path& reader)
      : drawn_(drawn), snap_(snap), found_(between_all(reader)) {}

  NamedRegions named() {
    if (found_.rings.empty()) throw DrawingError(fmt::format("the lines enclose nothing{}", gaps()));
    for (const Label& told : drawn_.told)
      if (!is_enclosed(told))
        throw DrawingError(
            fmt::format("{} m is in no region that lines enclose{}", place_text(told.at), gaps()));
    for (const auto& rings : found_.rings)
      if (const std::string name = name_of(rings); !name.empty()) named_.regions.push_back({name, rings});
    look_for_names_outside();
    for (const Gap& gap : found_.gaps) named_.notes.push_back(text_of(gap));
    return std::move(named_);
  }

  /// Whether the open lines enclose anything that the closed shapes do not.
  bool divides(const std::filesystem::path& reader) const {
    if (drawn_.closed.empty() || !drawn_.told.empty()) return true;
    std::vector<Polygon> lines = closed_lines();
    make_lines_meet(lines, snap_);
    return regions_between(lines, reader).rings.size() != found_.rings.size();
  }

 private:
  std::vector<Polygon> closed_lines() const {
    std::vector<Polygon> lines;
    for (const Region& region : drawn_.closed)
      for (const Polygon& ring : region.rings) {
        lines.push_back(ring);
        if (ring.front() != ring.back()) lines.back().push_back(ring.front());
      }
    return lines;
  }

  Regions between_all(const std::filesystem::path& reader) {
    std::vector<Polygon> lines = closed_lines();
    for (const Line& line : drawn_.lines) lines.push_back(line.points);
    const double moved = make_lines_meet(lines, snap_);
    if (moved > 1e-9) named_.notes.push_back(fmt::format("ends up to {:.2g} m apart were made one", moved));
    return regions_between(lines, reader);
  }

  /// Of the layer on which the end of a line lies that leaves this gap.
  std::string layer_at(const Point& end) const {
    for (const Line& line : drawn_.lines)
      for (const Point& p : {line.points.front(), line.points.back()})
        if ((p - end).norm() <= snap_) return line.layer;
    return "";
  }

  std::string text_of(const Gap& gap) const {
    return fmt::format(
        "a line on layer '{}' ends at {} m{}", layer_at(gap.at), place_text(gap.at),
        gap.width < 0 ? std::string() : fmt::format(", {:.3g} m from the next one", gap.width));
  }

  /// For the end of a message.
  std::string gaps() const {
    std::string text;
    for (std::size_t i = 0; i < std::min(most_named, found_.gaps.size()); ++i)
      text += (i == 0 ? ": " : "; ") + text_of(found_.gaps[i]);
    if (found_.gaps.size() > most_named)
      text += fmt::format("; and {} more", found_.gaps.size() - most_named);
    double widest = 0;
    for (const Gap& gap : found_.gaps) widest = std::max(widest, gap.width);
    if (widest > 0) text += fmt::format("; --snap {:g} would make all of them meet", a_little_above(widest));
    return text;
  }

  bool is_enclosed(const Label& label) const {
    return std::ranges::any_of(found_.rings, [&](const auto& rings) { return is_in(label.at, rings); });
  }

  static std::vector<Label> those_in(const std::vector<Label>& labels, const std::vector<Polygon>& rings) {
    std::vector<Label> inside;
    for (const Label& label : labels)
      if (is_in(label.at, rings)) inside.push_back(label);
    return inside;
  }

  /// "" where the region is said to be no soil.
  std::string name_of(const std::vector<Polygon>& rings) const {
    if (const auto told = those_in(drawn_.told, rings); !told.empty()) return told.front().text;
    const std::vector<Label> texts = those_in(drawn_.texts, rings);
    for (const Label& text : texts) {
      if (text.text == texts[0].text) continue;
      throw DrawingError(
          fmt::format("texts {} and {} m are in one region{}. Where both belong there, --skip LAYER leaves "
                      "out those of a "
                      "layer ('{}', '{}'), and --name {},{}=SOIL names the region",
                      drawn::text_of(texts[0]), drawn::text_of(text), gaps(), texts[0].layer, text.layer,
                      coordinate_text(texts[0].at.x()), coordinate_text(texts[0].at.y())));
    }
    if (!texts.empty()) return texts[0].text;
    const Point inside = point_in(rings);
    const Region* around = nullptr;
    for (const Region& closed : drawn_.closed)
      if (is_in(inside, closed.rings) &&
          (around == nullptr || area_of(closed.rings) < area_of(around->rings)))
        around = &closed;
    if (around != nullptr) return around->name;
    throw DrawingError(fmt::format(
        "no text names the region around {0} m, of {1:.3g} m2 and about {2:.2g} m wide: put one there, or "
        "--name {3},{4}=SOIL does, or --empty {3},{4} where no soil is{5}",
        place_text(inside), area_of(rings), width_of(rings), coordinate_text(inside.x()),
        coordinate_text(inside.y()),
        width_of(rings) < 20 * snap_
            ? "; a sliver between two lines that are meant to be one goes by a wider "
              "--snap"
            : ""));
  }

  void look_for_names_outside() {
    for (const Label& text : drawn_.texts) {
      if (is_enclosed(text)) continue;
      if (!found_.gaps.empty())
        throw DrawingError(fmt::format(
            "the text {} m is in no region that lines enclose, and there are gaps{}. Where it names no soil, "
            "--skip '{}' leaves out its layer",
            drawn::text_of(text), gaps(), text.layer));
      named_.notes.push_back(
          fmt::format("text {} m: left out, as no lines enclose it", drawn::text_of(text)));
    }
  }

  const Linework& drawn_;
  double snap_;
  NamedRegions named_;
  Regions found_;
};

}  // namespace

NamedRegions regions_of_lines(const Linework& drawn, double snap, const std::filesystem::path& reader) {
  Namer namer(drawn, snap, reader);
  if (namer.divides(reader)) return namer.named();
  NamedRegions as_drawn{drawn.closed, {}};
  for (const Line& line : drawn.lines)
    as_drawn.notes.push_back(
        fmt::format("line on layer '{}': left out, as it neither is closed nor divides a soil", line.layer));
  return as_drawn;
}

}  // namespace porosph::drawn
