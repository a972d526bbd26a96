// porosph fem: the finite-element reference of a case.
#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "app/command.hpp"
#include "app/memory.hpp"
#include "app/results.hpp"
#include "app/shipped_cases.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/stages.hpp"
#include "solver/reference/fem/demand.hpp"
#include "solver/reference/fem/solve.hpp"
#include "solver/run/probe.hpp"
#include "solver/space/place_text.hpp"
#include "solver/water/standing_water.hpp"
#include "vtk_io/fem_mesh.hpp"
#include "vtk_io/fem_vtu.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/folder_lock.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

constexpr double usual_triangles = 2100;
constexpr double long_wait = 10;  // s, that is announced

/// Refuses what does not fit, announces what takes long.
void check_demand(const Case& scene, double edge) {
  const FemDemand demand = fem_demand(scene, edge);
  check_fem_demand(demand, memory_here());
  if (demand.seconds < long_wait) return;
  fmt::print("about {:.3g} unknowns, {:.2g} GB of memory, {:.0f} s\n", demand.unknowns, demand.bytes / 1e9,
             demand.seconds);
  std::fflush(stdout);
}

/// In the order of probe_quantities().
std::vector<double> readings(const FemPoint& p) {
  const auto& s = p.effective_stress;
  return {s[0], s[1], s[2], s[3], p.pore_pressure, p.displacement.x(), p.displacement.y()};
}

std::string probe_table(const Case& scene, const FemSolution& solution) {
  std::string csv = "probe,x,y";
  for (const std::string& quantity : probe_quantities()) csv += "," + quantity;
  for (const ProbeCase& probe : scene.probes) {
    csv += fmt::format("\n{},{:.17g},{:.17g}", probe.name, probe.position.x(), probe.position.y());
    for (double value : readings(solution.at(probe.position))) csv += fmt::format(",{:.17g}", value);
  }
  return csv + "\n";
}

void tell(const Case& scene, const FemSolution& solution) {
  fmt::print("{} triangles, {} unknowns, {:.2f} s, rounding {:.0e}\n", solution.mesh().triangles.size(),
             solution.unknowns, solution.seconds, solution.rounding);
  for (const ProbeCase& probe : scene.probes) {
    const FemPoint p = solution.at(probe.position);
    fmt::print("{} {}: sigma'_yy = {:.3f} kPa, u_y = {:.3f} mm\n", probe.name, place_text(probe.position),
               p.effective_stress[1] / 1e3, p.displacement.y() * 1e3);
  }
  if (const double tension = largest_mean_tension(scene, solution); tension > 0)
    fmt::print(
        "note: a soil that carries no tension comes out with a mean tension of {:.3g} kPa; the elastic "
        "reference "
        "does not hold there\n",
        tension / 1e3);
}

}  // namespace

int fem_command(const Arguments& arguments) {
  std::string case_file, out;
  std::vector<std::string> overrides;
  double edge = 0;
  po::options_description options;
  options.add_options()("case", po::value(&case_file)->required(), "the case file")(
      "out", po::value(&out)->value_name("DIR"),
      "folder for fem.vtu and probes.csv (default: results/<case>_fem)")(
      "edge", po::value(&edge)->value_name("METRES"),
      "length of the triangles' edges far from corners (default: as makes about 2100 triangles)")(
      "set", po::value(&overrides)->value_name("KEY=VALUE"),
      "replaces a setting of the case; may be given again")("force", "replace another case's results");
  po::positional_options_description positional;
  positional.add("case", 1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "fem CASE.toml [options]",
             "  porosph fem cases/embankment.toml\n  porosph fem cases/embankment.toml --edge 0.3 --out "
             "results/fine\n",
             values))
    return Exit::done;
  if (values.count("edge") > 0 && !(edge > 0 && std::isfinite(edge)))
    throw UsageError(fmt::format("--edge = {}: must be > 0 m", edge));
  Case scene = read_case(find_case(case_file), overrides);
  require_plain(scene, "porosph fem");
  if (scene.loading.horizontal != 0)
    throw UsageError("fem: gravity is upright in the finite elements, but loading.horizontal is given");
  scene.water = at_rest_from(scene.water, scene.time.end);
  const fs::path folder =
      out.empty() ? fs::path("results") / (fs::path(case_file).stem().string() + "_fem") : fs::path(out);
  const std::string case_text = write_case(scene);
  const FolderLock lock(folder);
  if (values.count("force") == 0) check_owner(folder, case_text, true);
  if (edge == 0) edge = fem_edge(scene, usual_triangles);
  check_demand(scene, edge);
  const FemSolution solution = solve_fem(scene, mesh_case(scene, edge));
  take_folder(folder, case_text);
  write_file(folder / "probes.csv", probe_table(scene, solution));
  write_fem_vtu(solution, folder / "fem.vtu");
  fmt::print("{}: finite elements, results in {}\n", scene.title, folder.string());
  tell(scene, solution);
  return Exit::done;
}

}  // namespace porosph::app
