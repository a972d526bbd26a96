#include "render/bands.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace porosph::render {
namespace {

struct Corner {
  Pixel at;
  double value;
};

bool is_finite(const TriangleField& field, const std::array<int, 3>& t) {
  return std::ranges::all_of(t,
                             [&](int i) { return std::isfinite(field.values[static_cast<std::size_t>(i)]); });
}

Corner between(const Corner& a, const Corner& b, double level) {
  const double t = (level - a.value) / (b.value - a.value);
  return {{a.at.x + t * (b.at.x - a.at.x), a.at.y + t * (b.at.y - a.at.y)}, level};
}

/// The part of a convex polygon above (sign 1) or below (-1) a level.
int clip(const std::array<Corner, 6>& from, int count, double level, double sign, std::array<Corner, 6>& to) {
  int out = 0;
  for (int i = 0; i < count; ++i) {
    const Corner &a = from[static_cast<std::size_t>(i)], &b = from[static_cast<std::size_t>((i + 1) % count)];
    const bool a_in = sign * (a.value - level) >= 0, b_in = sign * (b.value - level) >= 0;
    if (a_in) to[static_cast<std::size_t>(out++)] = a;
    if (a_in != b_in) to[static_cast<std::size_t>(out++)] = between(a, b, level);
  }
  return out;
}

void append(std::vector<BandPiece>& pieces, const std::array<Corner, 6>& corners, int count, int band) {
  if (count < 3) return;
  BandPiece piece{.corners = {}, .count = count, .band = band};
  for (int i = 0; i < count; ++i)
    piece.corners[static_cast<std::size_t>(i)] = corners[static_cast<std::size_t>(i)].at;
  pieces.push_back(piece);
}

int band_of(double value, std::span<const double> levels) {
  return static_cast<int>(std::upper_bound(levels.begin(), levels.end(), value) - levels.begin());
}

/// An edge of the triangles, whichever way it is walked.
std::uint64_t edge_key(int a, int b) {
  const auto low = static_cast<std::uint64_t>(std::min(a, b)),
             high = static_cast<std::uint64_t>(std::max(a, b));
  return high << 32 | low;
}

/// Points that segments share, by a name: where an edge is crossed, or a point of the field.
class Chains {
 public:
  void add(std::uint64_t from, Pixel from_at, std::uint64_t to, Pixel to_at) {
    const int a = node(from, from_at), b = node(to, to_at);
    if (a == b) return;
    neighbours_[static_cast<std::size_t>(a)].push_back(b);
    neighbours_[static_cast<std::size_t>(b)].push_back(a);
  }

  /// Lines through all segments, each used once; open ones first.
  std::vector<std::vector<Pixel>> lines() {
    std::vector<std::vector<Pixel>> all;
    for (const bool open : {true, false})
      for (std::size_t i = 0; i < at_.size(); ++i)
        while (neighbours_[i].size() % 2 == (open ? 1 : 0) && !neighbours_[i].empty())
          all.push_back(walk(static_cast<int>(i)));
    return all;
  }

 private:
  int node(std::uint64_t name, Pixel at) {
    const auto [found, added] = numbers_.try_emplace(name, static_cast<int>(at_.size()));
    if (added) at_.push_back(at), neighbours_.emplace_back();
    return found->second;
  }

  std::vector<Pixel> walk(int from) {
    std::vector<Pixel> line = {at_[static_cast<std::size_t>(from)]};
    while (!neighbours_[static_cast<std::size_t>(from)].empty()) {
      const int to = neighbours_[static_cast<std::size_t>(from)].back();
      neighbours_[static_cast<std::size_t>(from)].pop_back();
      auto& back = neighbours_[static_cast<std::size_t>(to)];
      back.erase(std::ranges::find(back, from));
      line.push_back(at_[static_cast<std::size_t>(to)]);
      from = to;
    }
    return line;
  }

  std::unordered_map<std::uint64_t, int> numbers_;
  std::vector<Pixel> at_;
  std::vector<std::vector<int>> neighbours_;
};

constexpr std::uint64_t point_name = std::uint64_t{1} << 63;  // beside the names of edges

struct Names {
  const TriangleField& field;
  Corner corner(int i) const {
    return {field.points[static_cast<std::size_t>(i)], field.values[static_cast<std::size_t>(i)]};
  }
  bool above(int i, double level) const { return field.values[static_cast<std::size_t>(i)] >= level; }
  Pixel crossing(int a, int b, double level) const {  // the same from both sides, to the last bit
    return between(corner(std::min(a, b)), corner(std::max(a, b)), level).at;
  }
};

}  // namespace

std::vector<BandPiece> band_pieces(const TriangleField& field, std::span<const double> levels) {
  std::vector<BandPiece> pieces;
  pieces.reserve(field.triangles.size() + field.triangles.size() / 2);
  const Names names{field};
  for (const auto& t : field.triangles) {
    if (!is_finite(field, t)) continue;
    std::array<Corner, 6> whole = {names.corner(t[0]), names.corner(t[1]), names.corner(t[2])}, rest, part;
    int count = 3;
    const auto [low, high] = std::minmax({whole[0].value, whole[1].value, whole[2].value});
    const int first = band_of(low, levels), last = band_of(high, levels);
    for (int band = first; band < last; ++band) {
      const double level = levels[static_cast<std::size_t>(band)];
      append(pieces, part, clip(whole, count, level, -1, part), band);
      count = clip(whole, count, level, 1, rest);
      whole = rest;
    }
    append(pieces, whole, count, last);
  }
  return pieces;
}

std::vector<std::vector<Pixel>> isolines(const TriangleField& field, double level) {
  Chains chains;
  const Names names{field};
  for (const auto& t : field.triangles) {
    if (!is_finite(field, t)) continue;
    std::array<std::pair<std::uint64_t, Pixel>, 3> ends;
    int count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      if (names.above(a, level) != names.above(b, level))
        ends[static_cast<std::size_t>(count++)] = {edge_key(a, b), names.crossing(a, b, level)};
    }
    if (count == 2) chains.add(ends[0].first, ends[0].second, ends[1].first, ends[1].second);
  }
  return chains.lines();
}

std::vector<std::vector<Pixel>> region_above(const TriangleField& field, double level) {
  const Names names{field};
  std::unordered_map<std::uint64_t, int> uses;  // edges of one triangle only are the border
  for (const auto& t : field.triangles)
    if (is_finite(field, t))
      for (std::size_t i = 0; i < 3; ++i) ++uses[edge_key(t[i], t[(i + 1) % 3])];
  Chains chains;
  for (const auto& t : field.triangles) {
    if (!is_finite(field, t)) continue;
    std::array<std::pair<std::uint64_t, Pixel>, 3> ends;
    int count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      const bool a_above = names.above(a, level), b_above = names.above(b, level);
      const std::pair cut{edge_key(a, b), a_above != b_above ? names.crossing(a, b, level) : Pixel{}};
      if (a_above != b_above) ends[static_cast<std::size_t>(count++)] = cut;
      if (uses[edge_key(a, b)] != 1 || (!a_above && !b_above)) continue;
      const std::pair from = a_above
                                 ? std::pair{point_name | static_cast<std::uint64_t>(a), names.corner(a).at}
                                 : cut,
                      to = b_above ? std::pair{point_name | static_cast<std::uint64_t>(b), names.corner(b).at}
                                   : cut;
      chains.add(from.first, from.second, to.first, to.second);
    }
    if (count == 2) chains.add(ends[0].first, ends[0].second, ends[1].first, ends[1].second);
  }
  return chains.lines();
}

}  // namespace porosph::render
