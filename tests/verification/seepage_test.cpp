// Steady seepage, and the soil at rest in it.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/reference/exact/consolidation.hpp"
#include "solver/reference/exact/well.hpp"
#include "solver/water/flow/outline.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

const FlowRecord& flow_of(const Simulation& s) {
  const FlowRecord* record = s.model().pore_water->record();
  REQUIRE(record != nullptr);
  CHECK(std::abs(record->imbalance) < 1e-8);
  return *record;
}

double entering(const FlowRecord& flow) {
  double in = 0;
  for (const double q : flow.through_faces) in += std::max(q, 0.0);
  return in;
}

/// Where a column of particles next to x becomes dry [m].
double water_table(const Simulation& s, double x) {
  const Particles& p = s.model().particles;
  const FlowRecord& flow = flow_of(s);
  double nearest = never;
  for (const Vec2& at : p.position) nearest = std::min(nearest, std::abs(at.x() - x));
  std::vector<std::pair<double, double>> column;  // y, psi
  for (std::size_t i = 0; i < p.size(); ++i)
    if (std::abs(p.position[i].x() - x) < nearest + 1e-6)
      column.emplace_back(p.position[i].y(), flow.head[i] - p.position[i].y());
  std::ranges::sort(column);
  for (std::size_t k = 0; k + 1 < column.size(); ++k) {
    const auto [y, psi] = column[k];
    const auto [above, dry] = column[k + 1];
    if (psi >= 0 && dry < 0 && above > y) return y + (above - y) * psi / (psi - dry);
  }
  return std::nan("");
}

}  // namespace

TEST_CASE("seepage: the force of rising water lightens a column") {
  for (const double level : {7.0, 6.0, 4.5}) {  // m at the base: gradients of 0.5, 0.25 and -0.125
    const double gradient = (level - 5) / 4;
    const Settings settings = {fmt::format("water.face.1.level={:g}", level)};
    Simulation s(scene("upward_seepage", settings));
    run_to_end(s);
    CHECK(entering(flow_of(s)) == Approx(1e-5 * std::abs(gradient)).epsilon(1e-8));
    const double buoyant = 20e3 - 9810, weight = buoyant - gradient * 9810;
    double worst = 0;
    const Particles& p = s.model().particles;
    for (std::size_t i = 0; i < p.size(); ++i)
      worst = std::max(worst, std::abs(p.stress[i].yy + weight * (4 - p.start[i].y())));
    expect({.name = "upward_seepage",
            .settings = settings,
            .quantity = fmt::format(
                "vertical effective stress at a gradient of {:g}, largest error over 4 gamma'", gradient),
            .reference = "weight less buoyancy and seepage force",
            .resolution = metres(0.2)},
           worst / (4 * buoyant), 0.0003);
  }
}

TEST_CASE("seepage: the discharge of a dam and its water table") {
  // Free surface of Polubarinova-Kochina (1962) at a quarter, half and three quarters of the length.
  const double exact = 1e-5 * (24 * 24 - 4 * 4) / 32, table[] = {22.591, 20.430, 17.475};
  for (const double spacing : {1.0, 0.5}) {
    const Settings settings = {fmt::format("particles.spacing={:g}", spacing),
                               fmt::format("soil.0.retention.alpha={:g}", 2 / spacing)};
    Simulation s(scene("seepage_dam", settings));
    // Capillary flow above the water table adds what its kr carries: it vanishes with 1 / alpha.
    expect({.name = "seepage_dam",
            .settings = settings,
            .quantity = "discharge, with capillary flow of alpha = 2 / spacing",
            .reference = "Dupuit, Charny: k (H1^2 - H2^2) / 2 L",
            .resolution = metres(spacing)},
           entering(flow_of(s)) / exact - 1, 0.018 * spacing);
    double worst = 0;
    for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(water_table(s, 4 * (i + 1)) - table[i]));
    expect({.name = "seepage_dam",
            .settings = settings,
            .quantity = "water table, largest error over the height",
            .reference = "Polubarinova-Kochina",
            .resolution = metres(spacing)},
           worst / 24, spacing < 1 ? 0.012 : 0.02);
  }
}

TEST_CASE("seepage: the discharge under a sheet pile") {
  for (const double spacing : {0.25}) {
    const Settings settings = {};
    Case pile = scene("sheet_pile", settings);
    Simulation s(pile);
    expect({.name = "sheet_pile",
            .settings = settings,
            .quantity = "discharge",
            .reference = "conformal mapping, a pile without thickness (here 0.25 m): k h / 2",
            .resolution = metres(spacing)},
           std::abs(entering(flow_of(s)) / (1e-5 * 2 * 0.5) - 1), 0.055);
  }
}

namespace {

/// Where the particle is whose head is the lowest: the one that a well is.
Vec2 place_of_well(const Simulation& s, const FlowRecord& flow) {
  return s.model().particles.position[std::ranges::min_element(flow.head) - flow.head.begin()];
}

/// Of the head over ln r, r from the well, by least squares over the particles between both radii [m].
double slope_over_logarithm(const Particles& p, const FlowRecord& flow, const Vec2& well, double from,
                            double to) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double r = (p.position[a] - well).norm();
    if (r < from || r > to) continue;
    const double log_r = std::log(r), head = flow.head[a];
    n += 1, x += log_r, y += head, xx += log_r * log_r, xy += log_r * head;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace

TEST_CASE("seepage: a well draws by Thiem's formula, with the effective radius that docs/seepage.md tells") {
  constexpr double level = 20, fall = 5, k = 1e-5, radius = 0.163;  // of the well over the spacing
  for (const double spacing : {0.4, 0.2, 0.1}) {
    const Settings settings = {fmt::format("particles.spacing={:g}", spacing)};
    Simulation s(scene("well", settings));
    run_to_end(s);
    const FlowRecord& flow = flow_of(s);
    const Particles& p = s.model().particles;
    const Vec2 well = place_of_well(s, flow);
    const WellInRectangle exact({10, 10}, well);
    const double slope = entering(flow) / (2 * std::numbers::pi * k);  // of the head over ln r
    const auto row = [&](const std::string& quantity, const std::string& reference, double error,
                         double limit) {
      expect({.name = "well",
              .settings = settings,
              .quantity = quantity,
              .reference = reference,
              .resolution = metres(spacing)},
             error, limit);
    };
    row("slope of the head over ln r from 1 m to 3 m", "Thiem: q / (2 pi k), with the discharge found",
        std::abs(slope_over_logarithm(p, flow, well, 1, 3) / slope - 1), 0.002);
    double worst = 0;
    for (std::size_t a = 0; a < p.size(); ++a)
      if ((p.position[a] - well).norm() > 2.9 * spacing)
        worst = std::max(worst, std::abs(flow.head[a] - level + slope * exact.drop(p.position[a])) / fall);
    row("head three spacings from the well and beyond, largest error over the fall",
        "sum of images, with the discharge found", worst, 0.0005);
    row("discharge", "Thiem: 2 pi k (H - h) / ln(R / r), r = 0.163 spacing",
        std::abs(slope * std::log(exact.reach() / (radius * spacing)) / fall - 1), 0.0005);
  }
}

TEST_CASE("seepage: wells of one radius draw the same at all spacings") {
  for (const double spacing : {0.4, 0.2, 0.1})
    for (const double radius : {0.05, 0.01}) {
      if (radius >= DrainCase::own_radius * spacing) continue;
      const Settings settings = {fmt::format("particles.spacing={:g}", spacing),
                                 fmt::format("water.drain.well.radius={:g}", radius)};
      Simulation s(scene("well", settings));
      run_to_end(s);
      const WellInRectangle exact({10, 10}, place_of_well(s, flow_of(s)));
      const double drawn = 2 * std::numbers::pi * 1e-5 * 5 / std::log(exact.reach() / radius);
      expect({.name = "well",
              .settings = settings,
              .quantity = fmt::format("discharge of a well of {:g} cm radius", 100 * radius),
              .reference = "Thiem: 2 pi k (H - h) / ln(R / r)",
              .resolution = metres(spacing)},
             std::abs(entering(flow_of(s)) / drawn - 1), 0.0005);
    }
}

namespace {

/// Relative L2 error of the excess pressure over `load` [Pa], exact(depth / height).
template <class Exact>
double pressure_error(const Simulation& s, double height, double load, Exact&& exact) {
  double error = 0, size = 0;
  const Particles& p = s.model().particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double expected = exact(1 - p.start[a].y() / height);
    const double found = s.scene().water.unit_weight * s.consolidation()->head()[a] / load;
    error += std::pow(found - expected, 2), size += expected * expected;
  }
  return std::sqrt(error / size);
}

double settlement(const Simulation& s) {
  double lowest = 0;
  for (std::size_t a = 0; a < s.model().particles.size(); ++a)
    lowest = std::min(lowest, s.model().particles.displacement(a).y());
  return -lowest;
}

/// Runs to the end and calls measure(s) whenever a frame is due after the start.
template <class Measure>
void measure_at_frames(Simulation& s, Measure&& measure) {
  const auto frame = [&](Simulation& now) {
    if (now.time() > 0) measure(now);
  };
  run_to_end(s, {.frame = frame, .history = {}, .progress = {}, .interrupted = {}});
  CHECK(std::abs(s.consolidation()->imbalance()) < 1e-8 * s.consolidation()->drained());
}

}  // namespace

TEST_CASE("consolidation: a fill under its own weight") {
  constexpr double height = 4, buoyant = 16e3 - 9810, modulus = 12e6;  // M of E = 10 MPa, nu = 0.25
  Simulation s(scene("consolidation"));
  std::vector<std::pair<double, double>> errors;  // T, error
  measure_at_frames(s, [&](const Simulation& now) {
    const double factor = now.time() * 1e-9 * modulus / 9810 / (height * height);
    errors.emplace_back(factor, pressure_error(now, height, buoyant * height, [&](double depth) {
                          return own_weight_pressure(depth, factor);
                        }));
  });
  REQUIRE(errors.size() == 4);
  for (const auto& [factor, error] : errors)
    expect({.name = "consolidation",
            .settings = {},
            .quantity = fmt::format("excess pore pressure at T = {:.3g}, relative L2", factor),
            .reference = "Terzaghi's series, pressure growing with depth",
            .resolution = metres(0.2)},
           error,
           factor < 0.15  ? 0.0005
           : factor < 0.3 ? 0.0015
                          : 0.002);
  const double last = buoyant * height * height / (2 * modulus);
  expect({.name = "consolidation",
          .settings = {},
          .quantity = "settlement at T = 0.848 over the last one",
          .reference = "Terzaghi's degree of consolidation",
          .resolution = metres(0.2)},
         std::abs(settlement(s) / last - own_weight_degree(0.848)), 0.003);
}

TEST_CASE("consolidation: Mandel's specimen") {
  constexpr double width = 4, thickness = 2, force = 20e3, modulus = 10e6 * 0.8 / (1.2 * 0.6),
                   shear_modulus = 10e6 / 2.4;
  const Mandel exact(0.2);
  Simulation s(scene("mandel"));
  double highest = 0;
  measure_at_frames(s, [&](const Simulation& now) {
    const double factor = now.time() * 1e-8 * modulus / 9810 / (width * width);
    const Particles& p = now.model().particles;
    double squares = 0, all = 0;
    for (std::size_t a = 0; a < p.size(); ++a) {
      const double found = 9810 * now.consolidation()->head()[a] / (force / width);
      const double expected = exact.pressure(p.start[a].x() / width, factor);
      squares += (found - expected) * (found - expected), all += expected * expected;
      highest = std::max(highest, 2 * found);
    }
    const auto row = [&](const std::string& quantity, double error, double limit) {
      expect({.name = "mandel",
              .settings = {},
              .quantity = fmt::format("{} at T = {:.2g}", quantity, factor),
              .reference = "series of Mandel (1953)",
              .resolution = metres(0.2)},
             error, limit);
    };
    row("excess pore pressure, relative L2", std::sqrt(squares / all), 0.006);
    const double settled = 2 * shear_modulus * now.footings()[0].settlement(p) * width / (thickness * force);
    row("settlement of the plate", std::abs(settled / exact.strain(factor) - 1), 0.006);
    CHECK(now.footings()[0].force() == Approx(force).epsilon(1e-3));
  });
  CHECK(highest > 1.04);  // above the pressure that the load gives at once
}

TEST_CASE("consolidation: two layers") {
  const TwoLayers exact({2, 1e-6, 24e6}, {2, 1e-9, 12e6}, 9810);
  Simulation s(scene("two_layers"));
  measure_at_frames(s, [&](const Simulation& now) {
    expect({.name = "two_layers",
            .settings = {},
            .quantity = fmt::format("excess pore pressure after {:g} s, relative L2", now.time()),
            .reference = "series of eigenfunctions of both layers",
            .resolution = metres(0.2)},
           pressure_error(now, 4, 10e3, [&](double depth) { return exact.pressure(4 * depth, now.time()); }),
           0.005);
  });
  const double last = 10e3 * (2 / 24e6 + 2 / 12e6);
  const double above = 10e3 * 0.1 / 24e6;  // half a spacing of drained silt above the top particles
  expect({.name = "two_layers",
          .settings = {},
          .quantity = "settlement at the end over the last one",
          .reference = "series of eigenfunctions of both layers",
          .resolution = metres(0.2)},
         std::abs((settlement(s) + above) / last - exact.degree(s.time())), 0.005);
}
