// Loose sand on a base that shakes, against finite differences of the same equations in one dimension.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "solver/run/energy_budget.hpp"
#include "tests/verification/sand_column.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double height = 10, width = 2, rises_until = 1.7;

/// Particles by the height of their row, to the millimetre.
std::map<long, std::vector<std::size_t>> rows_of(const Simulation& s) {
  std::map<long, std::vector<std::size_t>> rows;
  const Particles& p = s.model().particles;
  for (std::size_t a = 0; a < p.size(); ++a) rows[std::lround(1e3 * p.start[a].y())].push_back(a);
  return rows;
}

double height_of(const Simulation& s, const std::vector<std::size_t>& row) {
  return s.model().particles.start[row.front()].y();
}

/// Excess pressure over the effective stress at the start.
double ratio_in(const Simulation& s, const std::vector<std::size_t>& row) {
  const double buoyant = s.scene().soils[0].unit_weight_saturated - s.scene().water.unit_weight;
  double sum = 0;
  for (const std::size_t a : row) sum -= s.water_in_motion()->excess()[a];
  return sum / static_cast<double>(row.size()) / (buoyant * (height - height_of(s, row)));
}

double mean_displacement(const Simulation& s, const std::vector<std::size_t>& row) {
  double sum = 0;
  for (const std::size_t a : row) sum += s.model().particles.displacement(a).y();
  return sum / static_cast<double>(row.size());
}

double settlement_of(const Simulation& s) { return -mean_displacement(s, rows_of(s).rbegin()->second); }

/// Mean over the rows of how far one lies off the middle of its neighbours [m].
double alternation_of(const Simulation& s) {
  std::vector<double> y;
  for (const auto& [at, row] : rows_of(s)) y.push_back(mean_displacement(s, row));
  double sum = 0;
  for (std::size_t i = 1; i + 1 < y.size(); ++i) sum += std::abs(y[i] - (y[i - 1] + y[i + 1]) / 2);
  return sum / static_cast<double>(y.size() - 2);
}

/// Volume that the soil has lost by its law [m2]: what has compacted, less what has opened, and elastic.
double compacted(const Simulation& s, const std::vector<Stress>& at_start) {
  const Particles& p = s.model().particles;
  double sum = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Soil& soil = s.model().soils[p.soil[a]];
    double strain = (p.stress[a].mean() - at_start[a].mean()) / soil.bulk_modulus();
    for (const HistoryField& h : p.history)
      strain += h.field.name == "Opening" ? h.values[a] : h.field.name == "Compaction" ? -h.values[a] : 0;
    sum -= p.volume(a) * strain;
  }
  return sum;
}

Measurement measured(const std::string& quantity, std::vector<std::string> settings = {"time.end=5"},
                     std::string reference = "finite differences in one dimension, 40 cells") {
  return {.name = "failure/liquefaction",
          .settings = std::move(settings),
          .quantity = quantity,
          .reference = std::move(reference),
          .resolution = metres(0.5)};
}

}  // namespace

TEST_CASE("loose sand liquefies on a base that shakes as finite differences say",
          "[water][dynamic][shaking]") {
  Simulation s(scene("failure/liquefaction", {"time.end=5"}));
  SandColumn column(s.scene(), 40, s.damping());
  const auto rows = rows_of(s);
  const auto middle = rows.lower_bound(4500)->second;
  double difference = 0, size = 0;
  const auto run_to = [&](double time) {
    while (s.time() < time && !s.instability()) {
      s.advance();
      column.run_to(s.time());
      const double ratio = column.ratio(height_of(s, middle));
      if (s.time() < rises_until) difference += std::abs(ratio_in(s, middle) - ratio), size += ratio;
    }
    REQUIRE_FALSE(s.instability());
  };
  run_to(3);
  expect(measured("r_u at mid-depth while it rises to 0.7, mean difference over mean"), difference / size,
         0.06);
  double off = 0;  // where both have liquefied
  for (const auto& [at, row] : rows)
    if (at > 6000 && at < 9000) off = std::max(off, std::abs(ratio_in(s, row) - 1));
  CHECK(column.ratio(7.75) == Approx(1).margin(0.005));
  expect(measured("1 - r_u from 1 to 4 m below the surface after 3 s, largest"), off, 0.03);
  const double settled = settlement_of(s), of_column = column.settlement();
  run_to(5);
  const double slower = (settlement_of(s) - settled) / (column.settlement() - of_column) - 1;
  expect(measured("settlement from 3 to 5 s, error"), std::abs(slower), 0.2);
  CHECK(s.water_in_motion()->counts().renewals > 0);
  CHECK(std::abs(s.water_in_motion()->imbalance()) < 1e-12);
}

TEST_CASE("liquefied sand settles by what it has compacted, without alternating from row to row",
          "[water][dynamic][shaking]") {
  Simulation s(scene("failure/liquefaction"));
  SandColumn column(s.scene(), 40, s.damping());
  const std::vector<Stress> at_start = s.model().particles.stress;
  double alternates = 0;
  const auto run_to = [&](double time) {
    while (s.time() < time && s.step() < s.last_step() && !s.instability()) s.advance();
    REQUIRE_FALSE(s.instability());
    alternates = std::max(alternates, alternation_of(s) / settlement_of(s));
  };
  const std::vector<std::string> whole;
  run_to(12);
  column.run_to(s.time());
  expect(measured("settlement at 12 s, error", {"time.end=12"}),
         std::abs(settlement_of(s) / column.settlement() - 1), 0.1);
  run_to(25);
  const double settled = settlement_of(s);
  expect(measured("alternation from row to row at 12 and 25 s, mean over settlement", whole, "none"),
         alternates, 0.08);
  const double drained = s.water_in_motion()->drained() / width;
  CHECK(std::abs(drained / settled - 1) < 0.003);
  expect(measured("settlement at 25 s over what its law has compacted, error", whole,
                  "Byrne's law of each particle"),
         std::abs(settled / (compacted(s, at_start) / width) - 1), 0.015);
}

TEST_CASE("ground between periodic sides moves alike across its width, and liquefied soil has its energy",
          "[water][dynamic][shaking]") {
  Simulation s(scene("failure/liquefaction", {"time.end=2.2", "loading.damping=0"}));
  const double at_start = s.energy().total();
  while (s.step() < s.last_step() && !s.instability()) s.advance();
  REQUIRE_FALSE(s.instability());
  double sideways = 0, largest = 0;
  for (const auto& [at, row] : rows_of(s))
    for (const std::size_t a : row) {
      const Particles& p = s.model().particles;
      sideways = std::max(sideways, (p.displacement(a) - p.displacement(row.front())).norm());
      largest = std::max(largest, p.displacement(a).norm());
    }
  INFO("across the width " << sideways << " of " << largest << " m");
  CHECK(sideways < 1e-5 * largest);
  const auto energy = energy_budget(s, at_start);
  REQUIRE(energy);
  INFO("released " << energy->released << ", base " << s.base().work() << ", unaccounted "
                   << energy->unaccounted << " of plastic " << energy->plastic << ", water " << energy->water
                   << ", control " << energy->control << ", walls " << energy->walls << ", diffusion "
                   << energy->diffusion);
  CHECK(std::abs(energy->unaccounted) < 0.02 * s.base().work());
}
