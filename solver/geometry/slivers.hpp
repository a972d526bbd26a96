// Small pieces of cells that an outline cuts off, and the neighbours that take them in.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/geometry/clip.hpp"
#include "solver/geometry/region.hpp"

namespace porosph {

/// What one cell of a lattice, or several joined ones, hold of a soil.
struct Piece {
  int cell = 0;                    ///< row * columns + column
  double area = 0;                 ///< [m2]
  Point centroid = Point::Zero();  ///< [m]
};

/// The cells below, left, right and above: the soil rests on the cell below, which comes first where edges
/// are equally long.
inline constexpr std::array<std::array<int, 2>, 4> cell_sides = {{{0, -1}, {-1, 0}, {1, 0}, {0, 1}}};
using SideLengths = std::array<double, 4>;  ///< of the edges shared with those cells [m]

/// Where a piece lies along those edges, seen from within one cell [m].
using SideStretches = std::array<Stretch, 4>;

struct Pieces {
  std::vector<Piece> all;                  ///< cell by cell; more than one where a cell is parted
  std::map<int, SideLengths> slivers;      ///< those that are to join a neighbour, by index into `all`
  std::map<int, SideStretches> stretches;  ///< of pieces at the outline
  int columns = 0, rows = 0;               ///< of the lattice
  double enough_area = 0;                  ///< what makes joined slivers a piece of their own [m2]
  double shortest_side = 0;                ///< of those that count, more than round-off [m]
};

/// What a cell from `low` to `high` holds of a region, as the clipped rings say together: each part that
/// hangs together by itself. A wall or slit thinner than the cell parts it, and no particle stands on both
/// sides.
std::vector<std::vector<Polygon>> parts_of_cell(const std::vector<Polygon>& clipped, const Region& region,
                                                const Point& low, const Point& high);

/// Adds what a cell, or a part of it, holds; less than `enough_area` is a sliver. `origin` [m]: near the
/// cell; side_of_cell(side): the half-plane that ends there.
void add_piece(Pieces& pieces, int cell, const std::vector<Polygon>& part, const Point& origin,
               const std::function<HalfPlane(int side)>& side_of_cell);

/// Joins slivers with the neighbour that they share the longest edge with, the smallest first, until none is
/// left that has a neighbour. Area and first moments of the whole are kept.
std::vector<Piece> join_slivers(Pieces pieces);

}  // namespace porosph
