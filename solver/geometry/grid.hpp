// The square lattice that particles are placed on.
#pragma once

#include <vector>

#include "solver/geometry/region.hpp"

namespace porosph {

/// Square cells over the bounding box of all soils, numbered row by row from its lower-left corner.
struct Grid {
  Point origin = Point::Zero();  ///< lower-left corner [m]
  double spacing = 0;            ///< side of a cell [m]
  int columns = 0, rows = 0;

  int cells() const { return columns * rows; }
  int cell(int column, int row) const { return row * columns + column; }
  int column(int cell) const { return cell % columns; }
  int row(int cell) const { return cell / columns; }
  bool has(int column, int row) const { return column >= 0 && column < columns && row >= 0 && row < rows; }
  double cell_area() const { return spacing * spacing; }  ///< [m2]
  Point centre(int cell) const {
    return {origin.x() + (column(cell) + 0.5) * spacing, origin.y() + (row(cell) + 0.5) * spacing};
  }
};

/// The cells that cover all regions. Throws std::runtime_error if they are too many to be counted.
Grid cover(const std::vector<Region>& regions, double spacing);

/// Where the cells of a grid lie with respect to a region.
enum class CellPlace : char {
  outside,     ///< no part of the outline within the margin of the cell; outside
  inside,      ///< no part of the outline within the margin of the cell; inside
  at_outline,  ///< the outline passes through or near the cell
};

/// One value per cell. margin: what counts as near, beyond the cell itself, to the left, right, below and
/// above [m].
std::vector<CellPlace> place_cells(const Grid& grid, const Region& region, double margin);

}  // namespace porosph
