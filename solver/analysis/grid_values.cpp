#include "solver/analysis/grid_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "solver/analysis/soil_values.hpp"

namespace porosph {
namespace {

constexpr double most_nodes = 1e7;

struct Box {
  Point low = Point::Constant(never), high = Point::Constant(-never);
};

/// Around the particles and half a spacing beyond, or, where the soil has not moved further than that from
/// it, around its outline.
Box box_of(const Frame& frame, const Case* scene, double particle_spacing) {
  Box box, outline;
  for (std::size_t i = 0; i < frame.points.size(); i += 3) {
    const Point p(frame.points[i], frame.points[i + 1]);
    if (p.allFinite()) box.low = box.low.cwiseMin(p), box.high = box.high.cwiseMax(p);
  }
  box.low -= Point::Constant(particle_spacing / 2), box.high += Point::Constant(particle_spacing / 2);
  if (scene == nullptr) return box;
  for (const SoilCase& soil : scene->soils)
    for (const Point& p : soil.polygon)
      outline.low = outline.low.cwiseMin(p), outline.high = outline.high.cwiseMax(p);
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(box.low[axis] - outline.low[axis]) < particle_spacing) box.low[axis] = outline.low[axis];
    if (std::abs(box.high[axis] - outline.high[axis]) < particle_spacing) box.high[axis] = outline.high[axis];
  }
  return box;
}

}  // namespace

GridValues values_on_grid(const Frame& frame, const Case* scene, double spacing,
                          const std::vector<FieldSelection>& fields) {
  if (!(spacing > 0)) throw std::invalid_argument("a grid needs a spacing > 0");
  const auto values = soil_values(frame, scene, fields, [](const Point& p, double) { return p.allFinite(); });
  if (!values) throw std::invalid_argument("the frame has no particles");
  const Box box = box_of(frame, scene, spacing_of(frame, scene));
  const Point size = (box.high - box.low) / spacing;
  const double columns = std::floor(size.x() + 1e-9) + 1, rows = std::floor(size.y() + 1e-9) + 1;
  if (!(columns * rows <= most_nodes))
    throw std::invalid_argument(fmt::format("a grid of {:.3g} nodes is too large; at most {:g} are computed",
                                            columns * rows, most_nodes));
  GridValues grid{.low = box.low,
                  .spacing = spacing,
                  .columns = static_cast<int>(columns),
                  .rows = static_cast<int>(rows),
                  .in_soil = {},
                  .values = values->no_points()};
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Point p = grid.low + spacing * Point(column, row);
      const InSoil hit = values->at(p, values->slack());
      grid.in_soil.push_back(hit.in_soil());
      if (hit.in_soil()) values->append(grid.values, hit, p);
    }
  return grid;
}

}  // namespace porosph
