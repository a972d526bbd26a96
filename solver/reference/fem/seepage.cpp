#include "solver/reference/fem/seepage.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "solver/reference/fem/assemble.hpp"
#include "solver/reference/fem/edges_on_faces.hpp"
#include "solver/space/place_text.hpp"
#include "solver/water/flow/steady_seepage.hpp"

namespace porosph {
namespace {

/// The small triangles of a P4 triangle, as places in p4::nodes().
const std::vector<std::array<int, 3>>& small_triangles() {
  static const auto all = [] {
    std::map<std::pair<int, int>, int> place;  // quarters of l1 and l2
    for (int k = 0; k < p4::node_count; ++k) {
      const p4::Barycentric& at = p4::nodes()[k];
      place[{static_cast<int>(std::lround(4 * at[1])), static_cast<int>(std::lround(4 * at[2]))}] = k;
    }
    std::vector<std::array<int, 3>> triangles;
    for (int i = 0; i < p4::order; ++i)
      for (int j = 0; i + j < p4::order; ++j) {
        triangles.push_back({place[{i, j}], place[{i + 1, j}], place[{i, j + 1}]});
        if (i + j + 1 < p4::order)
          triangles.push_back({place[{i + 1, j}], place[{i + 1, j + 1}], place[{i, j + 1}]});
      }
    return triangles;
  }();
  return all;
}

/// Conductances between the nodes, rows in order.
class Conductances {
 public:
  explicit Conductances(std::size_t nodes) : of_(nodes), volume_(nodes, 0) {}

  void add(const std::array<int, 3>& nodes, const P4Mesh& mesh, const Point& k) {
    const Point &a = mesh.nodes[nodes[0]], &b = mesh.nodes[nodes[1]], &c = mesh.nodes[nodes[2]];
    const double area = twice_area(a, b, c) / 2;
    const Eigen::Matrix2d map = gradient_map(a, b, c);
    Eigen::Matrix<double, 2, 3> gradient;
    gradient << -map.col(0) - map.col(1), map.col(0), map.col(1);
    for (int i = 0; i < 3; ++i) {
      volume_[nodes[i]] += area / 3;
      for (int j = 0; j < 3; ++j)
        if (i != j)
          of_[nodes[i]][nodes[j]] -=
              area * gradient.col(i).dot(Point(k.x() * gradient(0, j), k.y() * gradient(1, j)));
    }
  }

  FlowPairs pairs() const {
    FlowPairs out;
    out.begin = {0};
    for (const auto& row : of_) {
      for (const auto& [to, conductance] : row) out.pairs.push_back({to, conductance});
      out.begin.push_back(std::ssize(out.pairs));
    }
    out.face_begin.assign(of_.size() + 1, 0);
    out.volume = volume_;
    out.correction.assign(of_.size(), Mat2::Identity());
    return out;
  }

 private:
  std::vector<std::map<std::int32_t, double>> of_;
  std::vector<double> volume_;
};

/// Puts the nodes of the outline on its patches; a node between two lies on both.
void put_on_faces(const P4Mesh& mesh, const HydraulicOutline& outline, FlowPairs& pairs) {
  std::vector<std::pair<std::int32_t, std::int32_t>> on;
  for (const auto& [triangle, edge] : mesh.outline) {
    const auto& nodes = mesh.triangles[triangle];
    const std::array<int, 5> along{nodes[edge], nodes[3 + 3 * edge], nodes[4 + 3 * edge], nodes[5 + 3 * edge],
                                   nodes[(edge + 1) % 3]};
    const Point middle = mesh.nodes[along[2]];
    const int stretch = stretch_beside(outline, middle);
    const Wall& w = outline.stretches[stretch];
    for (const int node : along) {
      const Point inside = mesh.nodes[node] + 1e-6 * (middle - mesh.nodes[node]);
      on.emplace_back(node, outline.patch_at(stretch, (inside - w.from).dot((w.to - w.from).normalized())));
    }
  }
  std::ranges::sort(on);
  on.erase(std::unique(on.begin(), on.end()), on.end());
  for (const auto& [node, patch] : on) pairs.on_face.push_back(node), pairs.patch_of_on_face.push_back(patch);
  for (const HydraulicPatch& patch : outline.patches) {
    const Point middle = outline.middle(patch);
    pairs.beside_patch.push_back(std::ranges::min_element(
        pairs.on_face, {}, [&](std::int32_t n) { return (mesh.nodes[n] - middle).squaredNorm(); })[0]);
  }
}

}  // namespace

FemSeepage solve_fem_seepage(const Case& scene, const Mesh& mesh, const P4Mesh& nodes) {
  const std::size_t count = nodes.nodes.size();
  Conductances conductances(count);
  std::vector<std::int32_t> soil(count, static_cast<std::int32_t>(scene.soils.size()));
  for (std::size_t t = 0; t < nodes.triangles.size(); ++t) {
    for (const int n : nodes.triangles[t]) soil[n] = std::min(soil[n], mesh.soils[t]);
    for (const auto& small : small_triangles())
      conductances.add(
          {nodes.triangles[t][small[0]], nodes.triangles[t][small[1]], nodes.triangles[t][small[2]]}, nodes,
          scene.soils[mesh.soils[t]].permeability);
  }
  const HydraulicOutline outline =
      hydraulic_outline(scene.soils, scene.water.faces, shortest_outline_edge(mesh, nodes) / 4);
  FlowPairs pairs = conductances.pairs();
  put_on_faces(nodes, outline, pairs);
  std::vector<Retention> retention;
  for (const SoilCase& s : scene.soils) retention.emplace_back(s.retention, scene.particles.spacing);
  std::vector<double> height;
  for (const Point& p : nodes.nodes) height.push_back(p.y());

  const DarcyFlow flow(std::move(pairs), outline, retention, soil, height);
  const FaceConditions faces(outline, scene.water.faces);
  if (const std::int32_t n = flow.unreached(faces); n >= 0)
    throw std::runtime_error(fmt::format("finite elements: the soil around {} has no face with a head",
                                         place_text(nodes.nodes[n])));
  const SteadySeepage found = solve_steady(flow, faces, start_of_steady(scene.water.faces, height));
  FemSeepage result{
      .head = found.head,
      .pressure_head = {},
      .pore_pressure = {},
      .through_faces = through_faces(flow, outline, found.head, found.faces, scene.water.faces.size()),
      .newton_steps = found.newton_steps};
  for (std::size_t n = 0; n < count; ++n) {
    result.pressure_head.push_back(found.head[n] - height[n]);
    result.pore_pressure.push_back(-scene.water.unit_weight *
                                   flow.retention(n).effective(result.pressure_head.back()));
  }
  return result;
}

}  // namespace porosph
