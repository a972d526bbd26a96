// The shipped cases give the results that they gave before, to rounding: shipped_cases.csv has the digests. A
// change that is meant to alter results writes them again: POROSPH_WRITE_DIGESTS=FILE regression "[digests]".
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "solver/case/case_file.hpp"
#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

constexpr int steps = 120;

/// Sums over all particles, one of them with weights that no symmetry of the scene shares.
struct Digest {
  double sum = 0, squares = 0, weighted = 0;
};
using Digests = std::map<std::string, Digest>;

struct Scene {
  std::string name;  ///< under cases/
  std::vector<std::string> settings;
};

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  const std::filesystem::path root = std::filesystem::path(POROSPH_SOURCE_DIR) / "cases";
  for (const auto& folder : {root, root / "verification"})
    for (const auto& file : std::filesystem::directory_iterator(folder))
      if (file.path().extension() == ".toml")
        all.push_back({std::filesystem::relative(file.path(), root).string(), {}});
  std::sort(all.begin(), all.end(), [](const Scene& a, const Scene& b) { return a.name < b.name; });
  for (const char* motion : {"conventional", "proposed", "rho_squared"})
    all.push_back({"foundation.toml", {std::string("formulation.motion=") + motion}});
  all.push_back({"embankment_fast.toml",
                 {"particles.arrangement=disordered", "particles.disorder=0.2", "particles.spacing=0.5",
                  "formulation.closed_gradients=true"}});
  all.push_back({"foundation_fast.toml", {"particles.arrangement=surface", "particles.spacing=0.5"}});
  all.push_back({"foundation_fast.toml", {"soil.0.no_tension=true"}});
  return all;
}

Digests digests(const Scene& scene) {
  const auto file = std::filesystem::path(POROSPH_SOURCE_DIR) / "cases" / scene.name;
  Simulation simulation(read_case(file, scene.settings));
  for (int step = 0; step < steps; ++step) simulation.advance();
  REQUIRE_FALSE(simulation.instability());
  Digests found;
  Noise noise(1);
  const Particles& p = simulation.model().particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double weight = noise();
    const auto add = [&](const char* name, double value) {
      Digest& d = found[name];
      d.sum += value, d.squares += value * value, d.weighted += weight * value;
    };
    add("u_x", p.displacement(i).x()), add("u_y", p.displacement(i).y());
    add("v_x", p.velocity[i].x()), add("v_y", p.velocity[i].y());
    add("s_xx", p.stress[i].xx), add("s_yy", p.stress[i].yy);
    add("s_zz", p.stress[i].zz), add("s_xy", p.stress[i].xy);
    add("density", p.density[i]), add("p_w", p.pore_pressure[i]);
  }
  return found;
}

std::string label(const Scene& scene) {
  std::string text = scene.name;
  for (const std::string& setting : scene.settings) text += " " + setting;
  return text;
}

std::map<std::string, Digests> stored() {
  std::ifstream file(std::filesystem::path(POROSPH_SOURCE_DIR) / "tests/regression/shipped_cases.csv");
  std::map<std::string, Digests> all;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string scene, field;
    Digest d;
    char comma;
    std::getline(cells, scene, ',');
    std::getline(cells, field, ',');
    cells >> d.sum >> comma >> d.squares >> comma >> d.weighted;
    REQUIRE(cells);
    all[scene][field] = d;
  }
  return all;
}

}  // namespace

TEST_CASE("shipped cases give the results that they gave before", "[digests]") {
  constexpr double rounding = 1e-9;  // of vector units that add in another order, over 120 steps
  const auto before = stored();
  for (const Scene& scene : scenes()) {
    INFO(label(scene));
    REQUIRE(before.contains(label(scene)));
    for (const auto& [field, now] : digests(scene)) {
      INFO(field);
      const Digest then = before.at(label(scene)).at(field);
      const double size = std::sqrt(then.squares * 1e4) * rounding + 1e-12;
      CHECK(now.sum == Approx(then.sum).epsilon(0).margin(size));
      CHECK(now.squares == Approx(then.squares).epsilon(rounding).margin(1e-20));
      CHECK(now.weighted == Approx(then.weighted).epsilon(0).margin(size));
    }
  }
}

TEST_CASE("digests of the shipped cases are written where asked for", "[.][digests]") {
  const char* name = std::getenv("POROSPH_WRITE_DIGESTS");
  REQUIRE(name != nullptr);
  std::ofstream file(name);
  file << "scene,field,sum,squares,weighted\n";
  for (const Scene& scene : scenes())
    for (const auto& [field, d] : digests(scene))
      file << fmt::format("{},{},{},{},{}\n", label(scene), field, d.sum, d.squares, d.weighted);
  CHECK(file.flush());
}
