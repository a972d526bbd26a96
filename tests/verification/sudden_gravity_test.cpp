// Dynamics: a column that is suddenly given its weight, against the wave equation.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/reference/exact/dynamic_column.hpp"
#include "solver/run/monitor/energy.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

using Rows = std::vector<std::vector<double>>;

DynamicColumn exact_column(const Simulation& s) {
  const SoilCase& soil = s.scene().soils[0];
  return {.height = 10,
          .modulus = s.model().soils[0].constrained_modulus(),
          .density = soil.unit_weight_saturated / s.scene().loading.gravity,
          .unit_weight = soil.unit_weight_saturated - s.scene().water.unit_weight,
          .damping = s.scene().loading.damping / s.time_step()};
}

/// Columns of the history.
struct Place {
  int stress_yy, displacement_y;
  double height;
};
constexpr Place at_a{2, 7, 5}, at_top{9, 14, 10};

struct Swing {
  explicit Swing(const Settings& settings)
      : simulation(scene("sudden_gravity", settings)), exact(exact_column(simulation)) {
    REQUIRE(history_columns(simulation).at(at_a.stress_yy) == "A.EffectiveStress_YY");
    REQUIRE(history_columns(simulation).at(at_top.displacement_y) == "top.Displacement_Y");
    RunWatch watch;
    watch.history = [&](const std::vector<double>& row) { rows.push_back(row); };
    run_to_end(simulation, watch);
  }
  /// Root mean square of computed minus exact over that of exact.
  double error(int column, const std::function<double(double)>& exact_at) const {
    double difference = 0, reference = 0;
    for (const auto& row : rows) {
      const double e = exact_at(row[0]);
      difference += (row[column] - e) * (row[column] - e), reference += e * e;
    }
    return std::sqrt(difference / reference);
  }

  Simulation simulation;
  DynamicColumn exact;
  Rows rows;
};

/// Mean period: between the first and the last upward passage of `level`.
double period_of(const Rows& rows, int column, double level) {
  std::vector<double> passages;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double before = rows[i - 1][column] - level, after = rows[i][column] - level;
    if (before < 0 && after >= 0)
      passages.push_back(rows[i - 1][0] + (rows[i][0] - rows[i - 1][0]) * before / (before - after));
  }
  REQUIRE(passages.size() >= 3);
  return (passages.back() - passages.front()) / static_cast<double>(passages.size() - 1);
}

double lowest(const Rows& rows, int column) {
  double value = 0;
  for (const auto& row : rows) value = std::min(value, row[column]);
  return value;
}

}  // namespace

TEST_CASE("sudden gravity: the undamped column swings as d'Alembert's solution") {
  const Swing s({});
  const auto check = [&](const char* quantity, double error, double allowed) {
    expect({"sudden_gravity", {}, quantity, "d'Alembert's solution", metres(0.25)}, error, allowed);
  };
  const double static_top = -s.exact.unit_weight * 100 / (2 * s.exact.modulus);
  const double static_a = -s.exact.unit_weight * 5;
  check("period of the settlement, consistent form",
        std::abs(period_of(s.rows, at_top.displacement_y, static_top) / s.exact.period() - 1), 0.001);
  check("amplitude of the settlement, consistent form",
        std::abs(lowest(s.rows, at_top.displacement_y) / (2 * static_top) - 1), 0.005);
  check("largest stress at A, consistent form", std::abs(lowest(s.rows, at_a.stress_yy) / (2 * static_a) - 1),
        0.03);
  check("history of the settlement over five periods, relative L2, consistent form",
        s.error(at_top.displacement_y, [&](double t) { return s.exact.displacement(10, t); }), 0.02);
  check("history of the stress at A over five periods, relative L2, consistent form",
        s.error(at_a.stress_yy, [&](double t) { return s.exact.vertical_stress(5, t); }), 0.05);
}

TEST_CASE("sudden gravity: damping decays as it should") {
  const Settings settings = {"loading.damping=0.02"};
  const Swing s(settings);
  const auto check = [&](const char* quantity, double error, double allowed) {
    expect({"sudden_gravity", settings, quantity, "modal series with damping", metres(0.25)}, error, allowed);
  };
  check("history of the settlement, damped, relative L2, consistent form",
        s.error(at_top.displacement_y, [&](double t) { return s.exact.displacement(10, t); }), 0.002);
  check("history of the stress at A, damped, relative L2, consistent form",
        s.error(at_a.stress_yy, [&](double t) { return s.exact.vertical_stress(5, t); }), 0.004);
}

TEST_CASE("sudden gravity: the proposed form swings with the same period") {
  const Settings settings = {"formulation.motion=proposed"};
  const Swing s(settings);
  const double static_top = -s.exact.unit_weight * 100 / (2 * s.exact.modulus);
  expect({"sudden_gravity", settings, "period of the settlement, proposed form", "4 H / c_p", metres(0.25)},
         std::abs(period_of(s.rows, at_top.displacement_y, static_top) / s.exact.period() - 1), 0.02);
}

// The extrapolated stress below the bottom is not the adjoint of the strain there, so energy comes and goes a
// little within each period; what must not happen is a trend.
TEST_CASE("sudden gravity: energy is kept over a hundred periods") {
  const Settings settings = {"time.end=12.2", "particles.spacing=0.5", "formulation.bulk_viscosity=0",
                             "formulation.zero_energy_control=0"};
  Simulation s(scene("sudden_gravity", settings));
  const double period = exact_column(s).period();
  double largest_kinetic = 0, largest_total = 0, first_mean = 0, last_mean = 0;
  int first_count = 0, last_count = 0;
  RunWatch watch;
  watch.progress = [&](const Simulation&) {
    const Simulation::Energy e = s.energy();
    largest_total = std::max(largest_total, std::abs(e.total()));
    largest_kinetic = std::max(largest_kinetic, e.kinetic);
    if (s.time() < 10 * period) first_mean += e.total(), ++first_count;
    if (s.time() > 90 * period && s.time() < 100 * period) last_mean += e.total(), ++last_count;
  };
  run_to_end(s, watch);
  CHECK(s.time() > 100 * period);
  const double drift = std::abs(last_mean / last_count - first_mean / first_count) / largest_kinetic;
  expect({"sudden_gravity", settings,
          "energy drift from the first to the last 10 of 100 periods over the largest kinetic "
          "energy, consistent form",
          "conservation", metres(0.5)},
         drift, 2e-5);
  expect({"sudden_gravity", settings, "largest energy error at any instant of 100 periods, consistent form",
          "conservation", metres(0.5)},
         largest_total / largest_kinetic, 0.015);
}
