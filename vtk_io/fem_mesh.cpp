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
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>

#include "solver/case/shapes.hpp"
#include "solver/fem/mesh_points.hpp"

namespace porosph {
namespace {

/// Points far around the soil, so that no edge of it lies on the triangulation's convex hull, which VTK may
/// leave out.
void surround(vtkPoints* points) {
  double b[6];
  points->GetBounds(b);
  const Point centre((b[0] + b[1]) / 2, (b[2] + b[3]) / 2);
  const double radius = Point(b[1] - b[0], b[3] - b[2]).norm();
  for (int i = 0; i < 12; ++i) {
    const double angle = (i + 0.3) * std::numbers::pi / 6;
    points->InsertNextPoint(centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle), 0);
  }
}

/// The points, moved by up to `shift` [m]: vtkDelaunay2D leaves flat triangles between points that are
/// collinear but for rounding. Only the connections are taken from the moved points.
vtkNew<vtkPoints> moved(const std::vector<Point>& originals, double shift, unsigned seed) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-shift, shift);
  for (const Point& p : originals) {
    const double x = p.x() + move(random), y = p.y() + move(random);
    points->InsertNextPoint(x, y, 0);
  }
  return points;
}

/// The triangles of all points, with the edges kept where VTK can.
std::vector<std::array<int, 3>> triangulate(const MeshPoints& mesh, double h, unsigned seed) {
  const auto points = moved(mesh.points, 1e-7 * h, seed);
  surround(points);
  vtkNew<vtkCellArray> edges;
  for (const auto& [a, b] : mesh.edges) {
    edges->InsertNextCell(2);
    edges->InsertCellPoint(a);
    edges->InsertCellPoint(b);
  }
  vtkNew<vtkPolyData> input, constraints;
  input->SetPoints(points);
  constraints->SetPoints(points);
  constraints->SetLines(edges);
  vtkNew<vtkDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->SetSourceData(constraints);
  delaunay->SetTolerance(1e-9);
  delaunay->Update();

  std::vector<std::array<int, 3>> triangles;
  vtkCellArray* cells = delaunay->GetOutput()->GetPolys();
  vtkIdType count;
  const vtkIdType* v;
  for (cells->InitTraversal(); cells->GetNextCell(count, v);)
    triangles.push_back({static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])});
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

/// Triangles that have all the edges. What VTK did not recover is halved and tried again with other
/// movements.
std::vector<std::array<int, 3>> triangulate_with_edges(MeshPoints& mesh, double h) {
  constexpr unsigned tries = 6;
  std::vector<std::size_t> lost;
  for (unsigned seed = 0; seed < tries; ++seed) {
    auto triangles = triangulate(mesh, h, seed);
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
  throw std::runtime_error(fmt::format(
      "mesh: the triangulation lost the line at ({:.6g}, {:.6g}); try another edge length", at.x(), at.y()));
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
