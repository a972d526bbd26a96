#include "solver/reference/fem/solve.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "solver/reference/fem/assemble.hpp"
#include "solver/reference/fem/seepage.hpp"

namespace porosph {
namespace {

struct Solved {
  Eigen::VectorXd unknowns;
  double rounding = 0;  ///< FemSolution::rounding
};

std::runtime_error lost_to_rounding(const Case& scene, const std::string& what) {
  const auto [soft, stiff] = std::minmax_element(
      scene.soils.begin(), scene.soils.end(),
      [](const SoilCase& a, const SoilCase& b) { return a.youngs_modulus < b.youngs_modulus; });
  const std::string contrast =
      stiff->youngs_modulus > soft->youngs_modulus
          ? fmt::format(
                "; soil '{}' is {:.2g} times as stiff as soil '{}', which leaves too few digits for the "
                "soft one",
                stiff->name, stiff->youngs_modulus / soft->youngs_modulus, soft->name)
          : std::string();
  return std::runtime_error(
      fmt::format("finite elements: rounding spoils the solution: {}{}", what, contrast));
}

/// By Cholesky factors of the equilibrated matrix S A S with s_i = 1 / sqrt(a_ii) (van der Sluis 1969), so
/// that pivots of stiff and of soft soil are of one size, and refinement of the result (Golub and Van Loan,
/// Matrix Computations, 3.5.3). The change that a further refinement would make tells what rounding has left,
/// in the norm of energy. constrain() has made sure that A is positive definite: what fails here fails by
/// rounding.
Solved solve(const Case& scene, const LinearSystem& system) {
  if (system.load.size() == 0) return {system.load};  // every node is held
  constexpr double tolerable = 1e-5;
  constexpr int most_refinements = 5;
  const Eigen::VectorXd scale = system.stiffness.diagonal().array().rsqrt();
  const Eigen::SparseMatrix<double> scaled = scale.asDiagonal() * system.stiffness * scale.asDiagonal();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors(scaled);
  if (!scale.allFinite() || factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 0))
    throw lost_to_rounding(scene, "the equations are no longer positive definite");
  const Eigen::VectorXd load = scale.cwiseProduct(system.load);
  const auto unbalanced = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return load - scaled.selfadjointView<Eigen::Lower>() * x;
  };
  Solved solved{factors.solve(load), std::numeric_limits<double>::infinity()};
  for (int i = 0; i <= most_refinements; ++i) {
    const Eigen::VectorXd residual = unbalanced(solved.unknowns), change = factors.solve(residual);
    const double work = load.dot(solved.unknowns);
    const double left = work > 0 ? std::sqrt(std::abs(residual.dot(change)) / work) : residual.norm();
    if (!(left < solved.rounding / 2)) break;
    solved.rounding = left;
    if (i < most_refinements) solved.unknowns += change;
  }
  if (!(solved.rounding <= tolerable))
    throw lost_to_rounding(scene, fmt::format("to {:.2g} % in the norm of energy", 100 * solved.rounding));
  solved.unknowns = scale.cwiseProduct(solved.unknowns);
  return solved;
}

MeshWater water_of(const Case& scene, const Mesh& mesh, const P4Mesh& nodes) {
  if (scene.water.mode != WaterMode::steady) return {water_of_triangles(scene.water, mesh), {}, {}};
  FemSeepage seepage = solve_fem_seepage(scene, mesh, nodes);
  return {{}, std::move(seepage.pore_pressure), std::move(seepage.pressure_head)};
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
  const MeshWater water = water_of(scene, mesh, nodes);
  const Freedoms freedoms = constrain(scene, mesh, nodes);
  LinearSystem system = assemble(scene, mesh, nodes, water, freedoms);
  system.load += surface_load(scene, mesh, nodes, freedoms, scene.time.end);
  const Solved solved = solve(scene, system);
  FemSolution solution(scene, mesh, nodes, water, displacements(freedoms, solved.unknowns));
  solution.rounding = solved.rounding;
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
