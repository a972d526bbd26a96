#include "vtk_io/fem_mesh.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDelaunay2D.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>

#include "solver/case/shapes.hpp"
#include "solver/reference/fem/mesh_points.hpp"
#include "solver/space/place_text.hpp"

namespace porosph {
namespace {

/// Irregular points around the box of all, about 2 h apart and away from it: no edge of the soil may lie on
/// the triangulation's convex hull, which VTK may leave out, and far points would make slivers along straight
/// sides.
std::vector<Point> surrounding(const std::vector<Point>& all, double h, std::mt19937& random) {
  Eigen::AlignedBox2d box;
  for (const Point& p : all) box.extend(p);
  const double away = 2 * h;
  box = Eigen::AlignedBox2d(box.min().array() - 1.5 * away, box.max().array() + 1.5 * away);
  std::uniform_real_distribution<double> move(-0.4 * away, 0.4 * away);
  std::vector<Point> ring;
  for (int side = 0; side < 4; ++side) {
    const Point from =
        box.corner(std::array{box.BottomLeft, box.BottomRight, box.TopRight, box.TopLeft}[side]);
    const Point to = box.corner(std::array{box.BottomRight, box.TopRight, box.TopLeft, box.BottomLeft}[side]);
    const int pieces = static_cast<int>(std::ceil((to - from).norm() / away));
    for (int i = 0; i < pieces; ++i) {
      const Point p = from + (to - from) * i / pieces;
      const double x = p.x() + move(random), y = p.y() + move(random);
      ring.emplace_back(x, y);
    }
  }
  return ring;
}

/// The points' indices in an order that is random in the large and near in the small (Amenta, Choi and Rote
/// 2003, Incremental constructions con BRIO): a random half, before it a random quarter, and so on, each
/// sorted along the longer side of the box.
std::vector<int> insertion_order(const std::vector<Point>& points, std::mt19937& random) {
  const int count = static_cast<int>(points.size());
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (int i = count - 1; i > 0; --i)  // std::shuffle is not the same everywhere
    std::swap(order[i], order[random() % static_cast<unsigned>(i + 1)]);
  Eigen::AlignedBox2d box;
  for (const Point& p : points) box.extend(p);
  const int along = box.sizes().x() > box.sizes().y() ? 0 : 1;
  for (int end = count, begin; end > 0; end = begin) {
    begin = end / 2;
    const double strips =
        std::max(1.0, std::sqrt((end - begin) * box.sizes().minCoeff() / box.sizes().maxCoeff()));
    const double width = box.sizes()[1 - along] / strips;
    const auto strip = [&](int i) {
      return std::floor((points[i][1 - along] - box.min()[1 - along]) / width);
    };
    std::sort(order.begin() + begin, order.begin() + end, [&](int i, int j) {
      return std::pair(strip(i), points[i][along]) < std::pair(strip(j), points[j][along]);
    });
  }
  return order;
}

/// The Delaunay triangles of the points and of points around them, which have higher indices. Points are
/// moved by up to 1e-7 h: vtkDelaunay2D leaves flat triangles between points that are collinear but for
/// rounding. Inserted one straight line after the other they would make slivers, which it does not survive.
/// Its own recovery of edges is not asked for: in long and thin sections it does not end.
std::vector<std::array<int, 3>> triangulate(const std::vector<Point>& all, double h, unsigned seed) {
  std::mt19937 random(seed);
  const std::vector<Point> ring = surrounding(all, h, random);
  const std::vector<int> order = insertion_order(all, random);
  std::uniform_real_distribution<double> move(-1e-7 * h, 1e-7 * h);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point& p : ring) points->InsertNextPoint(p.x(), p.y(), 0);
  for (const int i : order) {
    const double x = all[i].x() + move(random), y = all[i].y() + move(random);
    points->InsertNextPoint(x, y, 0);
  }
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
  vtkNew<vtkDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->SetTolerance(1e-9);
  delaunay->Update();

  const auto around = static_cast<vtkIdType>(ring.size());
  const auto index = [&](vtkIdType i) {
    return i < around ? static_cast<int>(all.size()) + static_cast<int>(i) : order[i - around];
  };
  std::vector<std::array<int, 3>> triangles;
  vtkCellArray* cells = delaunay->GetOutput()->GetPolys();
  vtkIdType count;
  const vtkIdType* v;
  for (cells->InitTraversal(); cells->GetNextCell(count, v);)
    triangles.push_back({index(v[0]), index(v[1]), index(v[2])});
  return triangles;
}

/// Keeps the triangles inside the soils and the points that they use.
Mesh inside_soils(const Case& scene, const std::vector<Point>& points,
                  std::vector<std::array<int, 3>> triangles) {
  Mesh mesh;
  std::vector<int> vertex_of(points.size(), -1);
  const int count = static_cast<int>(points.size());
  for (auto& v : triangles) {
    if (std::any_of(v.begin(), v.end(), [&](int i) { return i >= count; }))
      continue;  // of a surrounding point
    const int soil = soil_at(scene, (points[v[0]] + points[v[1]] + points[v[2]]) / 3);
    if (soil < 0) continue;
    if (twice_area(points[v[0]], points[v[1]], points[v[2]]) < 0) std::swap(v[1], v[2]);
    for (int& i : v) {
      if (vertex_of[i] < 0) {
        vertex_of[i] = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(points[i]);
      }
      i = vertex_of[i];
    }
    mesh.triangles.push_back(v);
    mesh.soils.push_back(soil);
  }
  return mesh;
}

/// Indices of the edges that no triangle has.
std::vector<std::size_t> lost_edges(const MeshPoints& wanted,
                                    const std::vector<std::array<int, 3>>& triangles) {
  std::set<std::pair<int, int>> edges;
  for (const auto& v : triangles)
    for (int e = 0; e < 3; ++e) edges.insert(std::minmax(v[e], v[(e + 1) % 3]));
  std::vector<std::size_t> lost;
  for (std::size_t i = 0; i < wanted.edges.size(); ++i)
    if (!edges.contains(std::minmax(wanted.edges[i][0], wanted.edges[i][1]))) lost.push_back(i);
  return lost;
}

/// Triangles that have all the edges. Those that are not among the Delaunay triangles are halved, until their
/// pieces are (and VTK leaves out an edge now and then: so the points are moved otherwise each time).
std::vector<std::array<int, 3>> triangulate_with_edges(MeshPoints& mesh, double h) {
  constexpr unsigned tries = 12;
  std::vector<std::size_t> lost;
  for (unsigned seed = 0; seed < tries; ++seed) {
    auto triangles = triangulate(mesh.points, h, seed);
    lost = lost_edges(mesh, triangles);
    if (lost.empty()) return triangles;
    for (const std::size_t edge : lost) {
      const auto [a, b] = mesh.edges[edge];
      const int middle = static_cast<int>(mesh.points.size());
      mesh.points.push_back((mesh.points[a] + mesh.points[b]) / 2);
      mesh.edges[edge] = {a, middle};
      mesh.edges.push_back({middle, b});
    }
  }
  const Point& at = mesh.points[mesh.edges[lost.front()][0]];
  throw std::runtime_error(
      fmt::format("mesh: the triangulation lost the line at {}; try another edge length", place_text(at)));
}

void check_area(const Case& scene, const Mesh& mesh) {
  std::vector<double> filled(scene.soils.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    filled[mesh.soils[t]] += twice_area(mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]) / 2;
  }
  for (std::size_t s = 0; s < filled.size(); ++s) {
    const double wanted = area(scene.soils[s]);
    if (std::abs(filled[s] - wanted) > 1e-8 * wanted)
      throw std::runtime_error(fmt::format(
          "mesh: the triangles of soil '{}' cover {:.9g} m2 of its {:.9g} m2; try another edge length",
          scene.soils[s].name, filled[s], wanted));
  }
}

}  // namespace

Mesh mesh_case(const Case& scene, double h) {
  if (!(h > 0) || !std::isfinite(h))
    throw std::runtime_error(fmt::format("mesh: edge length is {} m; it must be finite and > 0", h));
  const MeshLines lines = mesh_lines(scene);
  MeshPoints points = mesh_points(scene, lines, mesh_size(scene, lines, h));
  const auto triangles = triangulate_with_edges(points, h);
  Mesh mesh = inside_soils(scene, points.points, triangles);
  check_area(scene, mesh);
  check_mesh(mesh, static_cast<int>(scene.soils.size()));
  return mesh;
}

}  // namespace porosph
