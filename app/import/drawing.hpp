// The shapes of a drawing, by layer.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph::drawn {

enum class ShapeKind {
  area,   ///< an outline and its holes
  line,   ///< an outline as well where it ends at its beginning
  rows,   ///< points of a table that follow each other: a line, or an outline where an area is meant
  point,  ///< one point, maybe with a text
};

struct Shape {
  std::string layer, text;
  ShapeKind kind = ShapeKind::line;
  std::vector<Polygon> rings;  ///< in the drawing's unit; one, but an area has its holes behind it
};

struct Drawing {
  std::string unit;  ///< of its coordinates, where it says so: "mm"
  std::vector<Shape> shapes;
  std::vector<std::string> left_out;  ///< what could not be taken, for people
};

class DrawingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An end of a line that meets no other one.
struct Gap {
  Point at = Point::Zero();
  double width = 0;  ///< to the nearest other line; negative: there is none
};

/// What lines enclose.
struct Regions {
  std::vector<std::vector<Polygon>> rings;  ///< of each region: its outline, then its holes
  std::vector<Gap> gaps;
};

/// Reads a DXF, GeoJSON, CSV or WKT file by `reader`, the program read_drawing. Throws DrawingError, which
/// names the file.
Drawing read_drawing(const std::filesystem::path& file, const std::filesystem::path& reader);

/// Cuts lines where they cross and joins the pieces to regions, by the same program. Throws DrawingError.
Regions regions_between(const std::vector<Polygon>& lines, const std::filesystem::path& reader);

}  // namespace porosph::drawn
