// Small pieces of cells that an outline cuts off, and the neighbours that take them in.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "solver/case/case.hpp"
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

struct Pieces {
  std::vector<Piece> all;              ///< at most one per cell
  std::map<int, SideLengths> slivers;  ///< those that are to join a neighbour, by index into `all`
  int columns = 0, rows = 0;           ///< of the lattice
  double enough_area = 0;              ///< what makes joined slivers a piece of their own [m2]
  double shortest_side = 0;            ///< of those that count, more than round-off [m]
};

/// The centroid of what a cell holds; where a wall or slit thinner than the cell parts it in two, that of the
/// larger part, as no particle stands on both sides.
Point middle_of_largest_part(const Region& region, const Point& low, const Point& high,
                             const Point& centroid);

/// Joins slivers with the neighbour that they share the longest edge with, the smallest first, until none is
/// left that has a neighbour. Area and first moments of the whole are kept.
std::vector<Piece> join_slivers(Pieces pieces);

}  // namespace porosph
