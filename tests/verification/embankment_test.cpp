// The embankment against converged finite elements on a grid of half a metre. Left out: one metre around the
// toes, where stress is singular, and half a metre around the crest's corners.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "solver/sph/neighbours/neighbour_list.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

enum Quantity { ux, uy, xx, yy, zz, xy, quantities };
using Values = std::array<double, quantities>;  // [m], [Pa]

struct Target {
  Vec2 place;
  Values values;
};

bool near_a_corner(const Vec2& p) {
  return (p - Vec2(10, 6)).norm() < 1 || (p - Vec2(33, 6)).norm() < 1 || (p - Vec2(15, 11)).norm() < 0.5 ||
         (p - Vec2(20.5, 11)).norm() < 0.5;
}

/// Columns: x, y, material, ux, uy, sxx, syy, szz, sxy [kPa], ...
std::vector<Target> finite_elements() {
  std::ifstream file(std::string(POROSPH_SOURCE_DIR) + "/cases/reference/embankment_fem_p4_probes.csv");
  std::string line;
  std::getline(file, line);
  std::vector<Target> targets;
  while (std::getline(file, line)) {
    std::array<double, 9> column{};
    std::istringstream cells(line);
    for (double& value : column) {
      std::string cell;
      std::getline(cells, cell, ',');
      value = std::stod(cell);
    }
    const Target t{
        {column[0], column[1]},
        {column[3], column[4], column[5] * 1e3, column[6] * 1e3, column[7] * 1e3, column[8] * 1e3}};
    if (!near_a_corner(t.place)) targets.push_back(t);
  }
  return targets;
}

/// Linear-exact from particles within three smoothing lengths, so that places on a slope see several rows of
/// them.
Values value_at(const Vec2& place, const Model& model) {
  const Particles& p = model.particles;
  const double h = 1.5 * model.smoothing_length;
  const std::vector<Vec2> here = {place};
  const auto index = find_neighbours(here, p.start, 2 * h).index;
  std::vector<Vec2> near;
  std::vector<double> volumes;
  for (std::int32_t b : index) near.push_back(p.start[b]), volumes.push_back(p.volume(b));
  const std::vector<double> weights = linear_weights(place, near, volumes, h);
  Values sum{};
  for (std::size_t i = 0; i < index.size(); ++i) {
    const std::int32_t b = index[i];
    const Vec2 u = p.displacement(b);
    const Stress& s = p.stress[b];
    const Values v = {u.x(), u.y(), s.xx, s.yy, s.zz, s.xy};
    for (int q = 0; q < quantities; ++q) sum[q] += weights[i] * v[q];
  }
  return sum;
}

Values relative_errors(const std::string& name, const Settings& settings) {
  Simulation s(scene(name, settings));
  run_to_end(s);
  Values difference{}, reference{}, error{};
  for (const Target& t : finite_elements()) {
    const Values found = value_at(t.place, s.model());
    for (int q = 0; q < quantities; ++q) {
      difference[q] += std::pow(found[q] - t.values[q], 2);
      reference[q] += std::pow(t.values[q], 2);
    }
  }
  for (int q = 0; q < quantities; ++q) error[q] = std::sqrt(difference[q] / reference[q]);
  return error;
}

void expect_all(const Measurement& like, const Values& allowed) {
  static constexpr const char* names[] = {
      "horizontal displacement", "vertical displacement", "sigma'_xx", "sigma'_yy", "sigma'_zz", "sigma_xy"};
  const Values error = relative_errors(like.name, like.settings);
  for (int q = 0; q < quantities; ++q) {
    Measurement what = like;
    what.quantity = std::string(names[q]) + ", relative L2, consistent form, " + like.quantity;
    expect(what, error[q], allowed[q]);
  }
}

// Near critical damping at a large time step: the same state of rest, sooner.
const Settings sooner = {"time.courant=0.9", "loading.damping=0.018", "time.end=3"};

}  // namespace

TEST_CASE("embankment: fitted particles against finite elements") {
  expect_all({"embankment", sooner, "fitted", "15-node finite elements", "8454 particles"},
             {0.012, 0.005, 0.01, 0.006, 0.006, 0.0175});
}

TEST_CASE("embankment: the plain lattice against finite elements") {
  Settings lattice = sooner;
  lattice.push_back("particles.arrangement=lattice");
  expect_all({"embankment", lattice, "lattice", "15-node finite elements", "8454 particles"},
             {0.016, 0.005, 0.02, 0.007, 0.009, 0.035});
}

// Finite elements are linear; the settlement's change of buoyancy alone is 0.4 % of the displacement.
TEST_CASE("embankment: the fast way against finite elements") {
  expect_all({"embankment_fast", {}, "surface", "15-node finite elements", "2250 particles"},
             {0.018, 0.006, 0.0145, 0.0075, 0.0075, 0.022});
}
