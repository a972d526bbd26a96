// porosph fem: the finite-element reference of a case.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include "app/command.hpp"
#include "app/memory.hpp"
#include "app/results.hpp"
#include "app/shipped_cases.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/stages.hpp"
#include "solver/reference/fem/consolidation.hpp"
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

constexpr double usual_triangles = 2100, usual_in_time = 500;
constexpr double long_wait = 10;  // s, that is announced

/// Refuses what does not fit, announces what takes long.
void check_demand(const Case& scene, double edge) {
  FemDemand demand = fem_demand(scene, edge);
  if (scene.water.couples()) {  // pressures besides, and one set of factors for each length of step: measured
    demand.unknowns *= 1.2, demand.bytes *= 3, demand.seconds *= 300;
  }
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

std::string head_of_table() {
  std::string csv = "probe,x,y";
  for (const std::string& quantity : probe_quantities()) csv += "," + quantity;
  return csv + "\n";
}

/// A line for each probe, which begins with `first`.
std::string probe_lines(const Case& scene, const FemSolution& solution, const std::string& first = "") {
  std::string csv;
  for (const ProbeCase& probe : scene.probes) {
    csv += fmt::format("{}{},{:.17g},{:.17g}", first, probe.name, probe.position.x(), probe.position.y());
    for (double value : readings(solution.at(probe.position))) csv += fmt::format(",{:.17g}", value);
    csv += "\n";
  }
  return csv;
}

/// The start, the times of the output and the end [s].
std::vector<double> times_of_output(const Case& scene) {
  std::vector<double> times = scene.output.times;
  const double end = scene.time.end, interval = scene.output.interval;
  for (int i = 1; interval > 0 && i * interval < end * (1 - 1e-9); ++i) times.push_back(i * interval);
  times.insert(times.end(), {0, end});
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void refuse_what_moves(const Case& scene) {
  if (scene.loading.horizontal != 0)
    throw UsageError("fem: gravity is upright in the finite elements, but loading.horizontal is given");
  if (scene.water.mode == WaterMode::transient)
    throw UsageError(
        "fem: water.mode = \"transient\": finite elements know water that is still, steady, coupled or "
        "undrained");
  if (scene.water.is_dynamic())
    throw UsageError("fem: water.motion = \"dynamic\": finite elements have no inertia");
}

/// The last state, and the table of the probes in all of them.
FemSolution solve(const Case& scene, const Mesh& mesh, std::string& table) {
  if (!scene.water.couples()) {
    FemSolution solution = solve_fem(scene, mesh);
    table = head_of_table() + probe_lines(scene, solution);
    return solution;
  }
  std::optional<FemSolution> last;
  table = "time," + head_of_table();
  consolidate_by_fem(scene, mesh, times_of_output(scene), [&](double time, const FemSolution& state) {
    table += probe_lines(scene, state, fmt::format("{:.17g},", time));
    last.emplace(state);
  });
  return *last;
}

void tell(const Case& scene, const FemSolution& solution) {
  fmt::print("{} triangles, {} unknowns, {:.2f} s", solution.mesh().triangles.size(), solution.unknowns,
             solution.seconds);
  if (solution.rounding > 0) fmt::print(", rounding {:.0e}", solution.rounding);
  fmt::print("\n");
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
      "length of the triangles' edges far from corners (default: as makes about 2100 triangles, or 500 where "
      "soil consolidates)")("set", po::value(&overrides)->value_name("KEY=VALUE"),
                            "replaces a setting of the case; may be given again")(
      "force", "replace another case's results");
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
  refuse_what_moves(scene);
  scene.water = at_rest_from(scene.water, scene.time.end);
  const fs::path folder =
      out.empty() ? fs::path("results") / (fs::path(case_file).stem().string() + "_fem") : fs::path(out);
  const std::string case_text = write_case(scene);
  const FolderLock lock(folder);
  if (values.count("force") == 0) check_owner(folder, case_text, true);
  if (edge == 0) edge = fem_edge(scene, scene.water.couples() ? usual_in_time : usual_triangles);
  check_demand(scene, edge);
  std::string table;
  const FemSolution solution = solve(scene, mesh_case(scene, edge), table);
  take_folder(folder, case_text);
  write_file(folder / "probes.csv", table);
  write_fem_vtu(solution, folder / "fem.vtu");
  fmt::print("{}: finite elements, results in {}\n", scene.title, folder.string());
  tell(scene, solution);
  return Exit::done;
}

}  // namespace porosph::app
