#include "solver/geometry/slivers.hpp"

#include <algorithm>
#include <queue>

#include "solver/geometry/moments.hpp"

namespace porosph {
namespace {

class SliverJoiner {
 public:
  explicit SliverJoiner(Pieces pieces) : pieces_(std::move(pieces)) {
    std::vector<int> piece_of_cell(pieces_.columns * pieces_.rows, -1);
    for (int i = static_cast<int>(pieces_.all.size()); i-- > 0;) piece_of_cell[pieces_.all[i].cell] = i;
    for (const auto& [i, sides] : pieces_.slivers) {
      joined_into_[i] = i;
      members_[i] = {i};
      for (int side = 0; side < 4; ++side) neighbours_[i][side] = neighbour(piece_of_cell, i, side);
    }
  }

  std::vector<Piece> join() {
    using Entry = std::pair<double, int>;  // area, piece
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const auto& [i, sides] : pieces_.slivers) queue.emplace(pieces_.all[i].area, i);
    while (!queue.empty()) {
      const auto [area, from] = queue.top();
      queue.pop();
      if (joined_into_[from] != from || pieces_.all[from].area != area) continue;  // has been joined since
      const int into = best_neighbour(from);
      if (into < 0) continue;
      join(from, into);
      if (members_.contains(into) && pieces_.all[into].area < pieces_.enough_area)
        queue.emplace(pieces_.all[into].area, into);
    }
    return remaining();
  }

 private:
  int neighbour(const std::vector<int>& piece_of_cell, int piece, int side) const {
    const int cell = pieces_.all[piece].cell, columns = pieces_.columns;
    const int column = cell % columns + cell_sides[side][0], row = cell / columns + cell_sides[side][1];
    const bool exists = column >= 0 && column < columns && row >= 0 && row < pieces_.rows;
    const int first = exists ? piece_of_cell[row * columns + column] : -1;
    return first >= 0 && is_of_cell(first + 1, pieces_.all[first].cell) ? beside(piece, side, first) : first;
  }

  bool is_of_cell(int piece, int cell) const {
    return piece < static_cast<int>(pieces_.all.size()) && pieces_.all[piece].cell == cell;
  }

  /// Of the pieces of a parted cell, the one that shares most of the edge.
  int beside(int piece, int side, int first) const {
    const Stretch own = pieces_.stretches.at(piece)[side];
    double longest = pieces_.shortest_side;
    int best = -1;
    for (int next = first; is_of_cell(next, pieces_.all[first].cell); ++next) {
      const Stretch other = pieces_.stretches.at(next)[3 - side];  // along the opposite direction
      const double shared = std::min(own.to, -other.from) - std::max(own.from, -other.to);
      if (shared > longest) longest = shared, best = next;
    }
    return best;
  }

  int root(int piece) const {
    for (auto found = joined_into_.find(piece); found != joined_into_.end() && found->second != piece;
         found = joined_into_.find(piece))
      piece = found->second;
    return piece;
  }

  int best_neighbour(int piece) const {
    int best = -1;
    double longest = pieces_.shortest_side;
    for (int member : members_.at(piece))
      for (int side = 0; side < 4; ++side) {
        const int next = neighbours_.at(member)[side];
        const double length = pieces_.slivers.at(member)[side];
        if (next < 0 || root(next) == piece || length < longest + pieces_.shortest_side) continue;
        best = root(next);
        longest = length;
      }
    return best;
  }

  void join(int from, int into) {
    Piece &a = pieces_.all[from], &b = pieces_.all[into];
    b.centroid = (a.area * a.centroid + b.area * b.centroid) / (a.area + b.area);
    b.area += a.area;
    joined_into_[from] = into;
    if (const auto group = members_.find(into); group != members_.end())
      group->second.insert(group->second.end(), members_[from].begin(), members_[from].end());
  }

  std::vector<Piece> remaining() const {
    std::vector<Piece> result;
    for (int i = 0; i < static_cast<int>(pieces_.all.size()); ++i)
      if (root(i) == i) result.push_back(pieces_.all[i]);
    return result;
  }

  Pieces pieces_;
  std::map<int, std::array<int, 4>> neighbours_;  // of slivers: pieces, -1 where there is none
  std::map<int, int> joined_into_;                // of slivers: piece, itself while on its own
  std::map<int, std::vector<int>> members_;       // of slivers: the slivers joined into it
};

/// How many pieces of the outline run through a cell, each from its border to its border or around in it.
int lines_across(const std::vector<Polygon>& clipped, const Point& low, const Point& high) {
  const double tolerance = 1e-9 * (high - low).norm();
  const auto inside = [&](const Point& p) {
    return ((p - low).array() > tolerance).all() && ((high - p).array() > tolerance).all();
  };
  int lines = 0;
  for (const Polygon& ring : clipped) {
    int starts = 0, within = 0;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      if (!inside((ring[i] + ring[j]) / 2)) continue;
      ++within;
      if (!inside(ring[j])) ++starts;
    }
    lines += starts == 0 && within > 0 ? 1 : starts;
  }
  return lines;
}

}  // namespace

std::vector<std::vector<Polygon>> parts_of_cell(const std::vector<Polygon>& clipped, const Region& region,
                                                const Point& low, const Point& high) {
  constexpr double round_off = 1e-9;
  if (lines_across(clipped, low, high) < 2) return {clipped};
  std::vector<std::vector<Polygon>> parts = region.parts_within(low, high);
  std::erase_if(parts, [&](const std::vector<Polygon>& part) {
    return moments(part, low).area < round_off * (high - low).prod();
  });
  if (parts.size() < 2) return {clipped};
  return parts;
}

void add_piece(Pieces& pieces, int cell, const std::vector<Polygon>& part, const Point& origin,
               const std::function<HalfPlane(int side)>& side_of_cell) {
  const Moments m = moments(part, origin);
  const int piece = static_cast<int>(pieces.all.size());
  const bool sliver = m.area < pieces.enough_area;
  for (int side = 0; side < 4; ++side) {
    const HalfPlane end = side_of_cell(side);
    if (sliver) pieces.slivers[piece][side] = length_on_line(part, end, pieces.shortest_side);
    pieces.stretches[piece][side] = stretch_on_line(part, end, pieces.shortest_side);
  }
  pieces.all.push_back({cell, m.area, origin + m.first / m.area});
}

std::vector<Piece> join_slivers(Pieces pieces) { return SliverJoiner(std::move(pieces)).join(); }

}  // namespace porosph
