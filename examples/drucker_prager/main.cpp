// Computes a case whose soils yield: drucker_prager CASE.toml FOLDER COHESION_IN_PA FRICTION_IN_DEGREES
#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <string>

#include "drucker_prager.hpp"
#include "solver/case/case_file.hpp"
#include "solver/output/fields.hpp"
#include "solver/simulation/run.hpp"
#include "vtk_io/particle_series.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

using namespace porosph;

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "Usage: drucker_prager CASE.toml FOLDER COHESION_IN_PA FRICTION_IN_DEGREES\n";
    return 2;
  }
  try {
    const Case scene = read_case(argv[1]);
    const std::filesystem::path folder = argv[2];
    const auto material = std::make_shared<DruckerPrager>(std::stod(argv[3]), std::stod(argv[4]));
    Simulation simulation(scene);
    for (const SoilCase& soil : scene.soils) simulation.set_material(soil.name, material);

    SeriesWriter series(folder, {.scene = script_scene(scene)});
    write_file(folder / "case.toml", write_case(scene));
    const auto write = [&](Simulation& s) { series.write(make_frame(s, scene.output.fields)); };
    const RunOutcome outcome = run(simulation, {.frame = write});

    const Particles& p = simulation.model().particles;
    const auto yielding =
        std::ranges::count_if(p.stress, [&](const Stress& s) { return material->yield(s) > -1; });
    double furthest = 0;
    for (std::size_t i = 0; i < p.size(); ++i) furthest = std::max(furthest, p.displacement(i).norm());
    std::cout << yielding << " of " << p.size() << " particles at yield, largest displacement " << furthest
              << " m at " << simulation.time() << " s " << outcome.message << '\n';
    return outcome.status == RunStatus::unstable ? 3 : 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
