// A sheet beside a pit in elastic ground against finite elements, in which it is a thin zone as stiff as it.
#include <cmath>

#include "solver/case/case_file.hpp"
#include "solver/reference/fem/solve.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/staged.hpp"
#include "vtk_io/fem_mesh.hpp"

using namespace porosph;

namespace {

constexpr double x = 10, top = 10, toe = 4, bottom_of_pit = 7, bending = 2e9;

/// Without the pit's soil; the sheet is still to come.
Case beside_a_pit(double spacing) {
  Case scene = box_of_soil(2, 2, spacing);
  scene.soils[0].polygon = {{0, 0}, {20, 0}, {20, top}, {x, top}, {x, bottom_of_pit}, {0, bottom_of_pit}};
  scene.soils[0].youngs_modulus = 1e9;
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {20, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 12});
  add_wall(scene, BoundaryKind::roller, {20, 0}, {20, 12});
  scene.particles.smoothing_ratio = 1;
  scene.particles.arrangement = Arrangement::stretched;
  scene.formulation = default_formulation(Motion::consistent);
  scene.loading.adaptive_damping = true;
  scene.time = {.end = 20, .courant = 0.6};
  scene.stop.unbalanced_force_ratio = 1e-6;
  return scene;
}

/// Of a zone `thick` in place of the sheet, of weight as the soil.
Case with_zone(double thick, double stiffness) {
  Case scene = beside_a_pit(0.25);
  const double left = x - thick / 2, right = x + thick / 2;
  SoilCase& soil = scene.soils[0];
  soil.polygon = {{0, 0},
                  {20, 0},
                  {20, top},
                  {right, top},
                  {right, toe},
                  {left, toe},
                  {left, bottom_of_pit},
                  {0, bottom_of_pit}};
  SoilCase zone = soil;
  zone.name = "zone", zone.polygon = box_outline(left, toe, right, top);
  zone.youngs_modulus = 12 * stiffness / std::pow(thick, 3), zone.poissons_ratio = 0;
  scene.soils.push_back(zone);
  return scene;
}

/// Concave towards x.
double moment_of_zone(const FemSolution& fem, double y, double thick) {
  constexpr int points = 64;
  double moment = 0;
  for (int i = 0; i < points; ++i) {
    const double off = thick * ((i + 0.5) / points - 0.5);
    moment -= fem.in_soil(1, {x + off, y})->effective_stress[1] * off * thick / points;
  }
  return moment;
}

}  // namespace

TEST_CASE("a sheet beside a pit tends to bend as finite elements say") {
  constexpr double thick = 0.1,
                   thin = 0.05;  // friction on the faces of a zone bends it: extrapolated to none
  const auto solved = [](double thickness) {
    const Case zone = with_zone(thickness, bending);
    return solve_fem(zone, mesh_case(zone, 0.8));
  };
  const FemSolution of_thick = solved(thick), of_thin = solved(thin);
  std::vector<double> moments_off, moved_off;
  for (const double spacing : {0.5, 0.25}) {
    Case scene = beside_a_pit(spacing);
    SheetCase sheet;
    sheet.name = "wall", sheet.from = {x, top}, sheet.to = {x, toe};
    sheet.bending_stiffness = bending, sheet.axial_stiffness = 12 * bending / (thin * thin);
    sheet.mass = 1, sheet.bonded = true;
    scene.sheets.push_back(sheet);
    Simulation s(scene);
    CHECK(run(s, {}).status == RunStatus::equilibrium);
    s.accelerations();
    const Sheet::Profile profile = s.sheets()[0].profile();
    double most = 0, off = 0, moved_most = 0, moved = 0;
    for (std::size_t i = 1; i + 1 < profile.drawn.size(); ++i) {
      const Point at = profile.drawn[i];
      const double moment =
          2 * moment_of_zone(of_thin, at.y(), thin) - moment_of_zone(of_thick, at.y(), thick);
      const double u = 2 * of_thin.at(at).displacement.x() - of_thick.at(at).displacement.x();
      most = std::max(most, std::abs(moment)), moved_most = std::max(moved_most, std::abs(u));
      off = std::max(off, std::abs(profile.sections[i].moment - moment));
      moved = std::max(moved, std::abs(profile.moved[i].x() - u));
    }
    moments_off.push_back(off / most), moved_off.push_back(moved / moved_most);
  }
  CAPTURE(moments_off, moved_off);
  CHECK(moments_off[1] < 0.07);  // of first order
  CHECK(moments_off[1] < 0.65 * moments_off[0]);
  CHECK(moved_off[1] < 0.06);
  CHECK(moved_off[1] < 0.75 * moved_off[0]);
}
