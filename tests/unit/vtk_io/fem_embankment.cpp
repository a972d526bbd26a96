// The finite-element reference against converged values of the embankment.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "fem_scenes.hpp"
#include "solver/reference/fem/solve.hpp"
#include "vtk_io/fem_mesh.hpp"

using namespace porosph;

namespace {

struct Probe {
  Point at, displacement;
  Eigen::Vector4d stress;  ///< XX YY ZZ XY [Pa]
  double pore_pressure;
};

/// Columns: x,y,material,ux,uy,sxx_eff,syy_eff,szz_eff,sxy,p_w,... in m and kPa.
std::vector<Probe> converged() {
  std::ifstream file(POROSPH_SOURCE_DIR "/cases/reference/embankment_fem_p4_probes.csv");
  std::vector<Probe> probes;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::vector<double> v;
    for (std::string cell; v.size() < 10 && std::getline(row, cell, ',');) v.push_back(std::stod(cell));
    probes.push_back({{v[0], v[1]}, {v[3], v[4]}, 1e3 * Eigen::Vector4d(v[5], v[6], v[7], v[8]), 1e3 * v[9]});
  }
  return probes;
}

bool near_corner(const Point& p) {
  return (p - Point(10, 6)).norm() < 1 || (p - Point(33, 6)).norm() < 1 || (p - Point(15, 11)).norm() < 0.5 ||
         (p - Point(20.5, 11)).norm() < 0.5;
}

}  // namespace

TEST_CASE("The embankment agrees with converged values") {
  const auto probes = converged();
  REQUIRE(probes.size() == 1449);
  double largest = 0;
  for (const Probe& probe : probes) largest = std::max(largest, probe.displacement.norm());
  const Case scene = test::embankment();
  const FemSolution solution = solve_fem(scene, mesh_case(scene, 0.6));
  double worst_stress = 0, worst_displacement = 0, worst_pressure = 0;
  for (const Probe& probe : probes) {
    if (near_corner(probe.at)) continue;
    const FemPoint p = solution.at(probe.at);
    worst_stress = std::max(worst_stress, (p.effective_stress - probe.stress).cwiseAbs().maxCoeff());
    worst_displacement = std::max(worst_displacement, (p.displacement - probe.displacement).norm());
    worst_pressure = std::max(worst_pressure, std::abs(p.pore_pressure - probe.pore_pressure));
  }
  INFO("triangles " << solution.mesh().triangles.size() << ", unknowns " << solution.unknowns << ", seconds "
                    << solution.seconds << ", worst stress " << worst_stress << " Pa, displacement "
                    << worst_displacement / largest);
  CHECK(worst_stress < 50);  // Pa; the largest stress is 200 kPa
  CHECK(worst_displacement < 1e-5 * largest);
  CHECK(worst_pressure < 0.1);
}

TEST_CASE("The embankment's point A, to the digits that are known") {
  const Case scene = test::embankment();
  const FemPoint a = solve_fem(scene, mesh_case(scene, 0.6)).at({17.7, 3});
  CHECK(a.effective_stress[0] == Approx(-20199.4).margin(1));
  CHECK(a.effective_stress[1] == Approx(-93570.1).margin(1));
  CHECK(a.effective_stress[2] == Approx(-28442.4).margin(1));
  CHECK(a.effective_stress[3] == Approx(-2236.2).margin(1));
  CHECK(a.displacement.x() == Approx(-0.98185e-3).margin(1e-8));
  CHECK(a.displacement.y() == Approx(-18.07666e-3).margin(2e-8));
}

TEST_CASE("Layers of two soils are exact: each a column on its own modulus") {
  const Case scene = test::layers(false);
  const FemSolution solution = solve_fem(scene, mesh_case(scene, 0.7));
  const auto modulus = [&](int s) {
    const double nu = scene.soils[s].poissons_ratio;
    return scene.soils[s].youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  };
  const double at_5 = -17e3, at_2 = at_5 - 3 * (21e3 - 9810), at_0 = at_2 - 2 * (18e3 - 9810);
  const double u_2 = (at_0 + at_2) / 2 * 2 / modulus(0), u_5 = u_2 + (at_2 + at_5) / 2 * 3 / modulus(1),
               u_6 = u_5 + at_5 / 2 / modulus(1);
  const auto close = [](double exact, double scale) { return Approx(exact).margin(1e-8 * std::abs(scale)); };
  CHECK(solution.at({1, 0}).effective_stress[1] == close(at_0, at_0));
  CHECK(solution.at({1, 2}).effective_stress[1] == close(at_2, at_0));
  CHECK(solution.at({3, 5}).effective_stress[1] == close(at_5, at_0));
  CHECK(solution.at({3, 6}).effective_stress[1] == close(0, at_0));
  CHECK(solution.at({2, 2}).displacement.y() == close(u_2, u_6));
  CHECK(solution.at({2, 5}).displacement.y() == close(u_5, u_6));
  CHECK(solution.at({2, 6}).displacement.y() == close(u_6, u_6));
  // Where soils meet, the one named first: clay, nu = 0.4.
  CHECK(solution.at({1, 2}).soil == 0);
  CHECK(solution.at({1, 2}).effective_stress[0] == close(at_2 * 0.4 / 0.6, at_0));
}
