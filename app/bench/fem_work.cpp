#include "app/bench/fem_work.hpp"

#include <omp.h>

#include <array>
#include <cmath>
#include <sstream>

#include "app/bench/reference_stress.hpp"
#include "solver/reference/exact/finite_strain_column.hpp"
#include "solver/reference/fem/solve.hpp"
#include "solver/run/reference_errors.hpp"
#include "vtk_io/fem_mesh.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::bench {
namespace {

struct Target {
  Point place;
  double stress;  ///< sigma'_yy [Pa]
};

/// Columns: x, y, material, ux, uy, sxx_eff, syy_eff [kPa], ...
std::vector<Target> probe_targets(const Bench& bench, const Case& scene) {
  std::istringstream file(read_file(bench.options().cases / "reference/embankment_fem_p4_probes.csv"));
  std::vector<Target> targets;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::array<double, 7> column{};
    for (std::string cell; double& value : column) std::getline(cells, cell, ','), value = std::stod(cell);
    if (const Point place(column[0], column[1]); counts(scene, place))
      targets.push_back({place, 1e3 * column[6]});
  }
  return targets;
}

/// A grid of half a metre inside the soil.
std::vector<Target> column_targets(const Case& scene) {
  const auto [column, bottom] = reference_column(scene);
  const FiniteStrainColumn exact(column);
  const Polygon& box = scene.soils[0].polygon;
  std::vector<Target> targets;
  for (double x = box[0].x() + 0.25; x < box[2].x(); x += 0.5)
    for (double y = box[0].y() + 0.25; y < box[2].y(); y += 0.5)
      targets.push_back({{x, y}, exact.vertical_stress(y - bottom)});
  return targets;
}

double error_of(const FemSolution& solution, const std::vector<Target>& targets) {
  double difference = 0, reference = 0;
  for (const Target& t : targets) {
    difference += std::pow(solution.at(t.place).effective_stress[1] - t.stress, 2);
    reference += t.stress * t.stress;
  }
  return std::sqrt(difference / reference);
}

}  // namespace

std::vector<WorkPoint> measure_fem(const Bench& bench, const std::string& scene_name, const Case& scene,
                                   const std::vector<double>& edges) {
  omp_set_num_threads(1);
  const std::vector<Target> targets =
      scene.reference == Reference::column ? column_targets(scene) : probe_targets(bench, scene);
  std::vector<WorkPoint> points;
  for (double edge : edges) {
    std::vector<double> seconds;
    WorkPoint point{.scene = scene_name,
                    .form = fem_form,
                    .strategy = "direct solution",
                    .spacing = edge,
                    .ending = "solved"};
    for (int round = 0; round < (bench.options().quick ? 1 : 3); ++round) {
      const Seconds before = now();
      const FemSolution solution = solve_fem(scene, mesh_case(scene, edge));
      seconds.push_back((now() - before).cpu);
      point.error = error_of(solution, targets);
      point.particles = solution.unknowns;
    }
    point.seconds = point.settled = spread_of(seconds);
    points.push_back(point);
  }
  return points;
}

}  // namespace porosph::bench
