#include <array>
#include <functional>
#include <map>
#include <queue>

#include "solver/geometry/arrangements.hpp"
#include "solver/geometry/clip.hpp"
#include "solver/geometry/moments.hpp"

namespace porosph {
namespace {

// Smaller pieces join a neighbour. Near one half, so that an outline keeps the particles whose cell centre
// lies inside, as on the plain lattice; not one half itself, which would hang on round-off: it is what a
// slope through the cells' corners cuts off. Areas reach 1.8 cells; at 0.35 only 1.4, but the stress comes
// out no better.
constexpr double sliver = 0.45;
constexpr double round_off = 1e-9;  // of a cell's area or side

/// What one cell, or several joined ones, hold of a soil.
struct Piece {
  int cell = 0;
  double area = 0;
  Point centroid = Point::Zero();
};

/// Length of the edges shared with the cell below, left, right and above: the soil rests on the cell below,
/// which comes first where edges are equally long.
using Sides = std::array<double, 4>;
constexpr std::array<std::array<int, 2>, 4> steps = {{{0, -1}, {-1, 0}, {1, 0}, {0, 1}}};

struct Pieces {
  std::vector<Piece> all;                 // by cell
  std::map<int, Sides> sides_of_slivers;  // index into all -> sides
};

HalfPlane side_of_cell(const Grid& grid, int cell, int side) {
  const Point normal(steps[side][0], steps[side][1]);
  return {normal, normal.dot(grid.centre(cell)) + grid.spacing / 2};
}

void cut_cell(const Grid& grid, int cell, std::vector<Polygon> row, Pieces& pieces) {
  clip(row, side_of_cell(grid, cell, 1));
  clip(row, side_of_cell(grid, cell, 2));
  const Point centre = grid.centre(cell);
  const Moments m = moments(row, centre);
  const double fraction = m.area / grid.cell_area();
  if (fraction < round_off) return;
  if (fraction > 1 - round_off) {
    pieces.all.push_back({cell, grid.cell_area(), centre});
    return;
  }
  if (fraction < sliver) {
    Sides& sides = pieces.sides_of_slivers[static_cast<int>(pieces.all.size())];
    for (int side = 0; side < 4; ++side)
      sides[side] = length_on_line(row, side_of_cell(grid, cell, side), round_off * grid.spacing);
  }
  pieces.all.push_back({cell, m.area, centre + m.first / m.area});
}

Pieces cut_cells(const Grid& grid, const Region& region) {
  const std::vector<CellPlace> places = place_cells(grid, region, 1e-6 * grid.spacing);
  Pieces pieces;
  for (int row = 0; row < grid.rows; ++row) {
    std::vector<Polygon> strip = region.rings();
    clip(strip, side_of_cell(grid, grid.cell(0, row), 0));
    clip(strip, side_of_cell(grid, grid.cell(0, row), 3));
    for (int cell = grid.cell(0, row); cell < grid.cell(0, row + 1); ++cell) {
      if (places[cell] == CellPlace::at_outline) cut_cell(grid, cell, strip, pieces);
      if (places[cell] == CellPlace::inside)
        pieces.all.push_back({cell, grid.cell_area(), grid.centre(cell)});
    }
  }
  return pieces;
}

/// Joins slivers with neighbours, the smallest first, until none is left that has a neighbour.
class SliverJoiner {
 public:
  SliverJoiner(const Grid& grid, Pieces pieces) : grid_(grid), pieces_(std::move(pieces)) {
    std::vector<int> piece_of_cell(grid_.cells(), -1);
    for (int i = 0; i < static_cast<int>(pieces_.all.size()); ++i) piece_of_cell[pieces_.all[i].cell] = i;
    for (const auto& [i, sides] : pieces_.sides_of_slivers) {
      joined_into_[i] = i;
      members_[i] = {i};
      for (int side = 0; side < 4; ++side) neighbours_[i][side] = neighbour(piece_of_cell, i, side);
    }
  }

  std::vector<Piece> join() {
    using Entry = std::pair<double, int>;  // area, piece
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const auto& [i, sides] : pieces_.sides_of_slivers) queue.emplace(pieces_.all[i].area, i);
    while (!queue.empty()) {
      const auto [area, from] = queue.top();
      queue.pop();
      if (joined_into_[from] != from || pieces_.all[from].area != area) continue;  // has been joined since
      const int into = best_neighbour(from);
      if (into < 0) continue;
      join(from, into);
      if (pieces_.all[into].area < sliver * grid_.cell_area()) queue.emplace(pieces_.all[into].area, into);
    }
    return remaining();
  }

 private:
  int neighbour(const std::vector<int>& piece_of_cell, int piece, int side) const {
    const int cell = pieces_.all[piece].cell;
    const int column = grid_.column(cell) + steps[side][0], row = grid_.row(cell) + steps[side][1];
    return grid_.has(column, row) ? piece_of_cell[grid_.cell(column, row)] : -1;
  }

  int root(int piece) const {
    for (auto found = joined_into_.find(piece); found != joined_into_.end() && found->second != piece;
         found = joined_into_.find(piece))
      piece = found->second;
    return piece;
  }

  int best_neighbour(int piece) const {
    int best = -1;
    double longest = round_off * grid_.spacing;
    for (int member : members_.at(piece))
      for (int side = 0; side < 4; ++side) {
        const int next = neighbours_.at(member)[side];
        const double length = pieces_.sides_of_slivers.at(member)[side];
        if (next < 0 || root(next) == piece || length < longest + round_off * grid_.spacing) continue;
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

  const Grid& grid_;
  Pieces pieces_;
  std::map<int, std::array<int, 4>> neighbours_;  // of slivers: pieces, -1 where there is none
  std::map<int, int> joined_into_;                // of slivers: piece, itself while on its own
  std::map<int, std::vector<int>> members_;       // of slivers: the slivers joined into it
};

}  // namespace

std::vector<CellSite> arrange_fitted(const Grid& grid, const std::vector<Region>& regions) {
  std::vector<CellSite> sites;
  for (std::size_t soil = 0; soil < regions.size(); ++soil)
    for (const Piece& piece : SliverJoiner(grid, cut_cells(grid, regions[soil])).join())
      sites.push_back({piece.cell, {piece.centroid, piece.area, static_cast<int>(soil)}});
  return sites;
}

}  // namespace porosph
