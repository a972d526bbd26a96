// Computes a case whose soils are softening clay: softening_clay CASE.toml FOLDER PEAK_IN_PA RESIDUAL_IN_PA
#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <string>

#include "softening_clay.hpp"
#include "solver/case/case_file.hpp"
#include "solver/output/fields.hpp"
#include "solver/run/run.hpp"
#include "vtk_io/particle_series.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

using namespace porosph;

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "Usage: softening_clay CASE.toml FOLDER PEAK_IN_PA RESIDUAL_IN_PA\n";
    return 2;
  }
  try {
    constexpr double reference_strain = 0.1;
    Case scene = read_case(argv[1]);
    scene.output.fields.push_back("PlasticStrain");
    const std::filesystem::path folder = argv[2];
    Simulation simulation(scene);
    for (const SoilCase& soil : scene.soils)
      simulation.set_law(soil.name, std::make_shared<SofteningClay>(
                                        Elasticity::from_young(soil.youngs_modulus, soil.poissons_ratio),
                                        std::stod(argv[3]), std::stod(argv[4]), reference_strain));

    SeriesWriter series(folder, {.scene = script_scene(scene)});
    write_file(folder / "case.toml", write_case(scene));
    const auto write = [&](Simulation& s) { series.write(make_frame(s, scene.output.fields)); };
    const RunOutcome outcome = run(simulation, {.frame = write});

    const Particles& p = simulation.model().particles;
    const auto yielded =
        std::ranges::count_if(p.history.at(0).values, [](double strain) { return strain > 0; });
    double furthest = 0;
    for (std::size_t i = 0; i < p.size(); ++i) furthest = std::max(furthest, p.displacement(i).norm());
    std::cout << yielded << " of " << p.size() << " particles have yielded, largest displacement " << furthest
              << " m at " << simulation.time() << " s " << outcome.message << '\n';
    return outcome.status == RunStatus::unstable ? 3 : 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
