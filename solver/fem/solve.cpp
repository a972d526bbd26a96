#include "solver/fem/solve.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "solver/fem/assemble.hpp"

namespace porosph {
namespace {

Eigen::VectorXd solve(const LinearSystem& system) {
  if (system.load.size() == 0) return system.load;  // every node is held
  const auto singular = [] {
    return std::runtime_error(
        "finite elements: the equations are singular; a part of the soil is not held, for instance one that "
        "touches "
        "the rest in a single point");
  };
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors(system.stiffness);
  if (factors.info() != Eigen::Success) throw singular();
  const Eigen::VectorXd pivots = factors.vectorD();
  if (!(pivots.minCoeff() > 1e-13 * pivots.maxCoeff())) throw singular();
  Eigen::VectorXd unknowns = factors.solve(system.load);
  const Eigen::VectorXd residual = system.load - system.stiffness.selfadjointView<Eigen::Lower>() * unknowns;
  if (!(residual.norm() <= 1e-8 * system.load.norm())) throw singular();
  return unknowns;
}

Eigen::Matrix2Xd displacements(const Freedoms& freedoms, const Eigen::VectorXd& unknowns) {
  Eigen::Matrix2Xd u(2, freedoms.nodes.size());
  for (std::size_t n = 0; n < freedoms.nodes.size(); ++n) {
    const NodeFreedom& node = freedoms.nodes[n];
    u.col(n) = node.directions.leftCols(node.count) * unknowns.segment(node.first_unknown, node.count);
  }
  return u;
}

}  // namespace

FemSolution solve_fem(const Case& scene, const Mesh& mesh) {
  const auto start = std::chrono::steady_clock::now();
  if (scene.loading.k0_stress)
    throw std::runtime_error(
        "finite elements: loading.k0_stress = true is not supported; the reference starts from an unstressed "
        "soil");
  check_mesh(mesh, static_cast<int>(scene.soils.size()));
  const P4Mesh nodes = place_nodes(mesh);
  const std::vector<TriangleWater> water = water_of_triangles(scene.water, mesh);
  const Freedoms freedoms = constrain(scene.boundaries, mesh, nodes);
  const Eigen::VectorXd unknowns = solve(assemble(scene, mesh, nodes, water, freedoms));
  FemSolution solution(scene, mesh, nodes, water, displacements(freedoms, unknowns));
  solution.unknowns = freedoms.unknowns;
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return solution;
}

double largest_mean_tension(const Case& scene, const FemSolution& solution) {
  double largest = 0;
  for (int t = 0; t < static_cast<int>(solution.mesh().triangles.size()); ++t) {
    if (!scene.soils[solution.mesh().soils[t]].no_tension) continue;
    for (const p4::Barycentric& node : p4::nodes())
      largest = std::max(largest, solution.in_triangle(t, node).effective_stress.head<3>().mean());
  }
  return largest;
}

}  // namespace porosph
