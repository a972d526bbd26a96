// Consolidation in two dimensions against finite elements.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "solver/reference/fem/consolidation.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double from_edge = 0.6;  // m left out around the strip's edge, where stress jumps
constexpr double two_rows = 0.4;   // m

/// What both methods say of the particles at one time.
struct State {
  std::vector<double> excess;      ///< [Pa]
  std::vector<Vec2> displacement;  ///< [m]
};

State of_particles(const Simulation& s) {
  State state;
  const Particles& p = s.model().particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    state.excess.push_back(s.scene().water.unit_weight * s.consolidation()->head()[a]);
    state.displacement.push_back(p.displacement(a));
  }
  return state;
}

State of_elements(const FemSolution& fem, const std::vector<Vec2>& places) {
  State state;
  for (const Vec2& x : places) {
    const FemPoint point = fem.at(x);
    state.excess.push_back(-point.pore_pressure + 9810 * x.y());
    state.displacement.push_back(point.displacement);
  }
  return state;
}

}  // namespace

TEST_CASE("consolidation: a strip load on clay, against finite elements") {
  Simulation s(scene("strip_on_clay"));
  const std::vector<Vec2> places = s.model().particles.start;
  std::map<double, State> particles, elements;
  run_to_end(s, {.frame =
                     [&](Simulation& now) {
                       if (now.time() > 0) particles[now.time()] = of_particles(now);
                     },
                 .history = {},
                 .progress = {},
                 .interrupted = {}});
  std::vector<double> times;
  for (const auto& [time, state] : particles) times.push_back(time);
  REQUIRE(times.size() == 5);
  consolidate_by_fem(s.scene(), mesh_rectangle(s.scene(), 0.5), times,
                     [&](double time, const FemSolution& fem) { elements[time] = of_elements(fem, places); });
  for (const double time : times) {
    const State &found = particles.at(time), &fem = elements.at(time);
    double off_pressure = 0, pressure = 0, off_motion = 0, motion = 0;
    const bool undrained = time < 1e4;  // but for a layer at the surface that is thinner than the spacing
    std::size_t middle = 0;
    for (std::size_t a = 0; a < places.size(); ++a) {
      if (places[a].norm() < places[middle].norm()) middle = a;
      if ((places[a] - Vec2(2, 0)).norm() < from_edge) continue;
      if (!undrained || places[a].y() < -two_rows)
        off_pressure += std::pow(found.excess[a] - fem.excess[a], 2), pressure += std::pow(fem.excess[a], 2);
      off_motion += (found.displacement[a] - fem.displacement[a]).squaredNorm();
      motion += fem.displacement[a].squaredNorm();
    }
    const auto row = [&](const std::string& quantity, double error, double limit) {
      expect({.name = "strip_on_clay",
              .settings = {},
              .quantity = fmt::format("{} after {:g} s", quantity, time),
              .reference = "15-node finite elements",
              .resolution = metres(0.25)},
             error, limit);
    };
    row(undrained ? "excess pore pressure below two rows, relative L2" : "excess pore pressure, relative L2",
        std::sqrt(off_pressure / pressure), undrained ? 0.03 : 0.01);
    row("displacement, relative L2", std::sqrt(off_motion / motion), undrained ? 0.015 : 0.005);
    row("settlement under the middle of the strip",
        std::abs(found.displacement[middle].y() / fem.displacement[middle].y() - 1),
        undrained ? 0.03 : 0.005);
  }
}
