#include "solver/geometry/slivers.hpp"

#include <functional>
#include <queue>

namespace porosph {
namespace {

class SliverJoiner {
 public:
  explicit SliverJoiner(Pieces pieces) : pieces_(std::move(pieces)) {
    std::vector<int> piece_of_cell(pieces_.columns * pieces_.rows, -1);
    for (int i = 0; i < static_cast<int>(pieces_.all.size()); ++i) piece_of_cell[pieces_.all[i].cell] = i;
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
    return exists ? piece_of_cell[row * columns + column] : -1;
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

}  // namespace

Point middle_of_largest_part(const Region& region, const Point& low, const Point& high,
                             const Point& centroid) {
  constexpr double round_off = 1e-9;
  const std::vector<Region::Part> parts = region.parts_within(low, high);
  const bool parted = parts.size() > 1 && parts[1].area > round_off * (high - low).prod();
  return parted ? parts[0].centroid : centroid;
}

std::vector<Piece> join_slivers(Pieces pieces) { return SliverJoiner(std::move(pieces)).join(); }

}  // namespace porosph
