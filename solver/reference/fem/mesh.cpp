#include "solver/reference/fem/mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace porosph {
namespace {

Eigen::AlignedBox2d rectangle_of(const Case& scene) {
  const auto refuse = [](const char* why) {
    throw std::runtime_error(fmt::format(
        "structured mesh: {}; allowed is one axis-parallel rectangle of one soil without holes", why));
  };
  if (scene.soils.size() != 1) refuse("the case has not exactly one soil");
  const SoilCase& soil = scene.soils.front();
  if (!soil.holes.empty()) refuse("the soil has holes");
  if (soil.polygon.size() != 4) refuse("the soil's polygon has not four corners");
  Eigen::AlignedBox2d box;
  for (const Point& p : soil.polygon) box.extend(p);
  for (int i = 0; i < 4; ++i) {
    const Point side = soil.polygon[(i + 1) % 4] - soil.polygon[i];
    if ((side.x() == 0) == (side.y() == 0)) refuse("the soil's sides are not parallel to the axes");
  }
  return box;
}

/// The values from `from` to `to`, through every stop between them, at most h apart.
std::vector<double> divide(double from, double to, std::vector<double> stops, double h) {
  const double tiny = 1e-9 * (to - from);
  std::erase_if(stops, [&](double s) { return !(s > from + tiny && s < to - tiny); });
  stops.push_back(to);
  std::sort(stops.begin(), stops.end());
  std::vector<double> values{from};
  for (const double stop : stops) {
    const double start = values.back();
    if (stop - start < tiny) continue;
    const int pieces = static_cast<int>(std::ceil((stop - start) / h - 1e-9));
    for (int i = 1; i < pieces; ++i) values.push_back(start + (stop - start) * i / pieces);
    values.push_back(stop);
  }
  return values;
}

}  // namespace

double twice_area(const Point& a, const Point& b, const Point& c) {
  const Point u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

double extent(const std::vector<Point>& points) {
  Eigen::AlignedBox2d box;
  for (const Point& p : points) box.extend(p);
  return points.empty() ? 0 : box.diagonal().norm();
}

Mesh mesh_rectangle(const Case& scene, double h) {
  if (!(h > 0))
    throw std::runtime_error(fmt::format("structured mesh: edge length is {}; it must be > 0", h));
  const Eigen::AlignedBox2d box = rectangle_of(scene);
  std::vector<double> x_stops, y_stops;
  for (const WaterStretch& stretch : scene.water.stretches) {
    x_stops.insert(x_stops.end(), {stretch.x_from, stretch.x_to});
    y_stops.push_back(stretch.level);
  }
  const auto stop_at = [&](const auto& stretches) {
    for (const auto& s : stretches)
      for (const Point& end : {s.from, s.to}) x_stops.push_back(end.x()), y_stops.push_back(end.y());
  };
  stop_at(scene.boundaries), stop_at(scene.loads), stop_at(scene.footings);
  const auto xs = divide(box.min().x(), box.max().x(), x_stops, h);
  const auto ys = divide(box.min().y(), box.max().y(), y_stops, h);

  Mesh mesh;
  for (const double y : ys)
    for (const double x : xs) mesh.vertices.emplace_back(x, y);
  const int columns = static_cast<int>(xs.size()), rows = static_cast<int>(ys.size());
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column + 1 < columns; ++column) {
      const int a = row * columns + column, b = a + 1, c = b + columns, d = a + columns;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  mesh.soils.assign(mesh.triangles.size(), 0);
  return mesh;
}

void check_mesh(const Mesh& mesh, int soil_count) {
  if (mesh.triangles.empty()) throw std::runtime_error("mesh: it has no triangles");
  if (mesh.soils.size() != mesh.triangles.size())
    throw std::runtime_error(
        fmt::format("mesh: {} triangles but {} soil indices", mesh.triangles.size(), mesh.soils.size()));
  const int vertex_count = static_cast<int>(mesh.vertices.size());
  std::map<std::array<int, 2>, int> users;
  std::vector<char> used(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    if (std::any_of(v.begin(), v.end(), [&](int i) { return i < 0 || i >= vertex_count; }))
      throw std::runtime_error(
          fmt::format("mesh: triangle {} names a vertex outside 0..{}", t, vertex_count - 1));
    if (mesh.soils[t] < 0 || mesh.soils[t] >= soil_count)
      throw std::runtime_error(
          fmt::format("mesh: triangle {} has soil {}; allowed is 0..{}", t, mesh.soils[t], soil_count - 1));
    const Point &a = mesh.vertices[v[0]], &b = mesh.vertices[v[1]], &c = mesh.vertices[v[2]];
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    if (!(twice_area(a, b, c) > 1e-6 * longest))
      throw std::runtime_error(
          fmt::format("mesh: triangle {} at ({}, {}) is flat or clockwise", t, a.x(), a.y()));
    for (const int i : v) used[i] = 1;
    for (int e = 0; e < 3; ++e)
      if (++users[{std::min(v[e], v[(e + 1) % 3]), std::max(v[e], v[(e + 1) % 3])}] > 2)
        throw std::runtime_error(
            fmt::format("mesh: more than two triangles share the edge {} of triangle {}", e, t));
  }
  if (const auto lone = std::find(used.begin(), used.end(), 0); lone != used.end())
    throw std::runtime_error(fmt::format("mesh: vertex {} belongs to no triangle", lone - used.begin()));
}

}  // namespace porosph
