#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "render/run/history_lines.hpp"
#include "render/run/stress_paths.hpp"
#include "render/run/water_curves.hpp"

using namespace porosph;
using namespace porosph::render;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A run of two soils, each with a probe, that recorded these effective stresses at both.
FinishedRun run_of(const std::vector<Stress>& stresses) {
  FinishedRun run;
  run.name = "run";
  Case scene;
  SoilCase sand;
  sand.name = "sand";
  sand.polygon = {{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  sand.law = LawKind::mohr_coulomb;
  sand.strength.cohesion = 5e3, sand.strength.friction_angle = 30;
  SoilCase clay = sand;
  clay.name = "clay";
  clay.polygon = {{0, 2}, {4, 2}, {4, 6}, {0, 6}};
  clay.law = LawKind::tresca;
  clay.strength.undrained_strength = 20e3, clay.strength.growth = 2e3;
  clay.strength.softening = SofteningKind::linear, clay.strength.sensitivity = 4;
  scene.soils = {sand, clay};
  scene.probes = {{"low", {2, 1}}, {"high", {2, 3}}};
  run.scene = scene;
  History history;
  history.columns = {"time"};
  for (const ProbeCase& probe : scene.probes)
    for (const char* name : {"EffectiveStress_XX", "EffectiveStress_YY", "EffectiveStress_ZZ",
                             "EffectiveStress_XY", "Displacement_Y"})
      history.columns.push_back(probe.name + "." + name);
  double time = 0;
  for (const Stress& s : stresses) {
    std::vector<double> row{time};
    for (int probe = 0; probe < 2; ++probe) row.insert(row.end(), {s.xx, s.yy, s.zz, s.xy, -0.001 * time});
    history.rows.push_back(row);
    time += 1;
  }
  run.history = history;
  return run;
}

/// Principal stresses of a plane state in any direction [Pa].
Stress turned(double s1, double s3, double zz, double angle) {
  const double middle = (s1 + s3) / 2, radius = (s1 - s3) / 2;
  return {middle + radius * std::cos(2 * angle), middle - radius * std::cos(2 * angle), zz,
          radius * std::sin(2 * angle)};
}

}  // namespace

TEST_CASE("stress points are those of the books, in any direction", "[paths]") {
  for (const double angle : {0.0, 0.3, 1.2}) {
    const StressPoint triaxial = stress_point(turned(-100e3, -300e3, -100e3, angle));
    CHECK(triaxial.p == Approx(500e3 / 3));
    CHECK(triaxial.q == Approx(200e3));
    CHECK(triaxial.s == Approx(200e3));
    CHECK(triaxial.t == Approx(100e3));
    const StressPoint across = stress_point(turned(-200e3, -250e3, -300e3, angle));
    CHECK(across.t == Approx(50e3));  // the stress across the plane is the largest
  }
}

TEST_CASE("soil at yield touches its strength in all three pictures", "[paths]") {
  // Mohr and Coulomb: s1 = N s3 + 2 c sqrt(N), compression positive, with N = tan^2(45 + phi / 2).
  const double n = std::pow(std::tan(60 * degree), 2), s3 = 40e3, s1 = n * s3 + 2 * 5e3 * std::sqrt(n);
  const FinishedRun run = run_of({{}, turned(-s3, -s1, -s3, 0.4)});
  const std::vector<FinishedRun> runs = {run};
  const auto height = [](const ChartSeries& line, double x) {
    const double part = (x - line.x[0]) / (line.x[1] - line.x[0]);
    return line.y[0] + part * (line.y[1] - line.y[0]);
  };
  const auto pq = stress_paths(runs, {"run"}, PathKind::pq), st = stress_paths(runs, {"run"}, PathKind::st),
             mohr = stress_paths(runs, {"run"}, PathKind::mohr);
  REQUIRE((pq.size() == 2 && st.size() == 2 && mohr.size() == 2));
  for (const Chart& chart : {pq[0], st[0]}) {
    CAPTURE(chart.title);
    REQUIRE(chart.series.size() >= 2);
    CHECK(chart.series[0].x.front() == 0);
    CHECK(chart.series[0].y.back() == Approx(height(chart.series[1], chart.series[0].x.back())));
  }
  const ChartSeries &circle = mohr[0].series[0], &strength = mohr[0].series[2];
  double nearest = never;
  for (std::size_t i = 0; i < circle.x.size(); ++i)
    nearest = std::min(nearest, height(strength, circle.x[i]) - circle.y[i]);
  CHECK(nearest == Approx(0).margin(0.002 * circle.y[45]));  // a tangent of a circle of 90 pieces
  CHECK(mohr[0].to_scale);
  const ChartSeries& level = mohr[0].series[1];  // the stress on level planes is on the circle
  CHECK(std::hypot(level.x[0] - (circle.x.front() + circle.x.back()) / 2, level.y[0]) ==
        Approx((circle.x.front() - circle.x.back()) / 2));
}

TEST_CASE("runs of different strength have each their own line", "[paths]") {
  const FinishedRun run = run_of({{}, {-10e3, -30e3, -10e3, 0}});
  FinishedRun stronger = run;
  stronger.scene->soils[0].strength.cohesion = 20e3;
  const auto lines = [](const std::vector<FinishedRun>& runs) {
    return stress_paths(runs, {"a", "b"}, PathKind::st)[0].series;
  };
  CHECK(lines({run, run}).size() == 3);
  const auto both = lines({run, stronger});
  REQUIRE(both.size() == 4);
  CHECK(both[3].label.ends_with(", b"));
  CHECK(both[3].y[0] == Approx(20 * std::cos(30 * degree) + both[3].x[0] * std::sin(30 * degree)));
}

TEST_CASE("undrained strength grows with depth and has what softening leaves", "[paths]") {
  const FinishedRun run = run_of({{}});
  const auto found = strength_at(*run.scene, {2, 3});
  REQUIRE(found.size() == 2);
  CHECK(found[0].cohesion == Approx(20e3 + 3 * 2e3));
  CHECK(found[0].undrained);
  CHECK(found[1].cohesion == Approx(26e3 / 4));
  CHECK(strength_at(*run.scene, {2, 1}).at(0).friction == Approx(30 * degree));
  CHECK(strength_at(*run.scene, {9, 9}).empty());
  Case elastic = *run.scene;
  elastic.soils[0].law = LawKind::elastic;
  CHECK(strength_at(elastic, {2, 1}).empty());
}

TEST_CASE("settlement is downwards, and over the logarithm of time where soil consolidates", "[paths]") {
  FinishedRun run = run_of({{}, {}, {}});
  const auto charts = settlement_curves({run}, {"run"});
  REQUIRE(charts.size() == 1);
  CHECK(charts[0].series.size() == 2);
  CHECK(charts[0].series[0].y[2] == Approx(2));  // mm
  CHECK_FALSE(charts[0].x.logarithmic);
  run.scene->water.mode = WaterMode::coupled;
  CHECK(settlement_curves({run}, {"run"})[0].x.logarithmic);
  run.history.reset();
  CHECK(settlement_curves({run}, {"run"}).empty());
}

TEST_CASE("all charts of a run have the same unit of time", "[paths]") {
  FinishedRun run = run_of({{}, {}, {}});
  run.history->columns.push_back("water.entered");
  for (std::vector<double>& row : run.history->rows) row.push_back(row[0]);
  const auto charts = [&] {
    return std::vector{settlement_curves({run}, {"run"})[0], stress_histories({run}, {"run"})[0],
                       water_curves({run}, {"run"})[0]};
  };
  for (const Chart& chart : charts()) {
    CHECK(chart.x.title == "t [s]");
    CHECK(chart.series[0].x == std::vector<double>{0, 1, 2});
  }
  for (std::vector<double>& row : run.history->rows) row[0] *= 2 * 86400;
  for (const Chart& chart : charts()) {
    CHECK(chart.x.title == "t [d]");
    CHECK(chart.series[0].x == std::vector<double>{0, 2, 4});
  }
}
