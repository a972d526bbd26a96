// A layer that slides down a slope without end: dry, under water, and with water that seeps along it.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double gravity = 9.81, slope = 20 * std::numbers::pi / 180, weight = 20e3, water = 9810;

enum class Wetness { dry, submerged, seepage };

struct Layer {
  Wetness wetness;
  const char* words;
  /// Of the weight: what drives the layer, and what presses it on its base.
  double driving, pressing;
  /// tan(phi) / tan(slope) at a factor of safety.
  double friction(double factor) const { return factor * std::tan(slope) * driving / pressing; }
  const char* reference() const {
    return wetness == Wetness::seepage ? "gamma' tan(phi) / (gamma_sat tan(20))" : "tan(phi) / tan(20)";
  }
  std::string name() const {
    return wetness == Wetness::seepage ? "infinite_slope_seepage" : "infinite_slope";
  }
  Settings settings(double factor) const {
    Settings s = {fmt::format("boundary.0.coefficient={:.6g}", friction(factor))};
    if (wetness == Wetness::submerged) s.emplace_back("water.level=4");
    return s;
  }
};

constexpr double buoyant = 1 - water / weight;
const Layer layers[] = {{Wetness::dry, "dry", 1, 1},
                        {Wetness::submerged, "under water", buoyant, buoyant},
                        {Wetness::seepage, "with seepage along it", 1, buoyant}};

/// Mean velocity and displacement down the slope.
struct Slide {
  double velocity = 0, way = 0;
};
Slide downhill(const Simulation& s) {
  const Vec2 along(std::cos(slope), -std::sin(slope));
  const Particles& p = s.model().particles;
  Slide sum;
  double mass = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    sum.velocity += p.mass[a] * p.velocity[a].dot(along);
    sum.way += p.mass[a] * p.displacement(a).dot(along);
    mass += p.mass[a];
  }
  return {sum.velocity / mass, sum.way / mass};
}

void run_until(Simulation& s, double time) {
  while (s.time() < time && !s.instability()) s.advance();
  REQUIRE_FALSE(s.instability());
}

/// Mean acceleration down the slope once the bounce by its weight is damped.
double acceleration(const Layer& layer, Settings settings) {
  Simulation s(scene(layer.name(), settings));
  run_until(s, 0.15);
  const double v0 = downhill(s).velocity, t0 = s.time();
  run_until(s, 0.45);
  return (downhill(s).velocity - v0) / (s.time() - t0);
}

}  // namespace

TEST_CASE("infinite slope: what the base of a sliding layer bears", "[infinite-slope]") {
  for (const Layer& layer : layers)
    for (const double factor : {0.5, 0.9}) {
      const Settings settings = layer.settings(factor);
      const double a = acceleration(layer, settings);
      const double found = 1 - a / (layer.driving * gravity * std::sin(slope));
      expect({.name = layer.name(),
              .settings = settings,
              .quantity = fmt::format("factor of safety of {:g}, {}: 1 - a / driving acceleration", factor,
                                      layer.words),
              .reference = layer.reference(),
              .resolution = metres(0.1)},
             std::abs(found / factor - 1), 0.01);
    }
}

TEST_CASE("infinite slope: rests within 2 % of its limit and slides beyond", "[infinite-slope]") {
  for (const Layer& layer : layers) {
    Slide first[2], later[2];
    for (const double factor : {1 / 0.98, 1 / 1.02}) {
      Settings settings = layer.settings(factor);
      settings.insert(settings.end(), {"loading.damping_until=0.3", "time.end=1.1"});
      Simulation s(scene(layer.name(), settings));
      run_until(s, 0.5);
      first[factor < 1] = downhill(s);
      run_until(s, 1);
      later[factor < 1] = downhill(s);
    }
    const double crept = later[0].way - first[0].way, faster = (later[1].velocity - first[1].velocity) / 0.5;
    const double expected = (1 - 1 / 1.02) * layer.driving * gravity * std::sin(slope);
    CAPTURE(layer.words);
    CHECK(std::abs(crept) < 1e-6);
    CHECK(faster == Approx(expected).epsilon(0.25));  // 0.5 % of what drives the layer
    note({.name = layer.name(),
          .settings = layer.settings(1 / 0.98),
          .quantity = fmt::format("slope over the one at which it begins to slide, {}", layer.words),
          .reference = layer.reference(),
          .resolution = metres(0.1)},
         "rests at 98 %, slides at 102 %", "2 %");
  }
}

namespace {

/// A layer of soil at a slope of `share` of the one at which it flows.
struct Limit {
  const char* words;
  double pull;      ///< tangent of the slope at which it flows
  double pressure;  ///< on its base over that of its own weight
  Settings settings;
  double spacing;
};

const Limit limits[] = {
    {"sand", 0.5, 1, {}, 0.1},
    {"sand under water that seeps along it", 0.5 * buoyant, buoyant, {"water={level=1}"}, 0.1},
    {"clay of c = gamma H / 2",
     0.5,
     1,
     {"particles.spacing=0.02", "soil.layer.cohesion=10e3", "soil.layer.friction_angle=0",
      "soil.layer.polygon=[[0, 0], [2, 0], [2, 1], [0, 1]]", "load.downhill.from=[2, 1]",
      "load.downhill.to=[2, 0]"},
     0.02},
};

/// How far the layer goes from 0.5 to 1 s, long after its start.
double flows_by(const Limit& limit, double share, Settings& settings) {
  const double pull = share * limit.pull;
  settings = limit.settings;
  settings.push_back(fmt::format("loading.horizontal={:g}", pull));
  for (const std::string end : {"uphill", "downhill"}) {
    settings.push_back(fmt::format("load.{}.pressure_to={:g}", end, limit.pressure * weight));
    settings.push_back(
        fmt::format("load.{}.traction_to=[0, {:g}]", end, (end == "uphill" ? -1 : 1) * pull * weight));
  }
  Simulation s(scene("infinite_slope_soil", settings));
  const auto way = [&] {
    double sum = 0, mass = 0;
    const Particles& p = s.model().particles;
    for (std::size_t a = 0; a < p.size(); ++a) sum += p.mass[a] * p.displacement(a).x(), mass += p.mass[a];
    return sum / mass;
  };
  run_until(s, 0.5);
  const double first = way();
  run_until(s, 1);
  return way() - first;
}

}  // namespace

// The lowest row lies half of a spacing above the base and bears shear up to there: clay, whose strength
// does not grow with depth, flows at c over the weight above it, 1 % later with 50 rows.
TEST_CASE("infinite slope: soil rests at 99 % of its limit and flows beyond", "[infinite-slope]") {
  for (const Limit& limit : limits) {
    const bool clay = limit.spacing < 0.1;
    const double beyond = clay ? 1.015 : 1.01;
    Settings settings;
    CAPTURE(limit.words);
    CHECK(std::abs(flows_by(limit, 0.99, settings)) < 1e-6);
    CHECK(flows_by(limit, beyond, settings) > 1e-3);
    note({.name = "infinite_slope_soil",
          .settings = settings,
          .quantity = fmt::format("slope over the one at which it begins to flow, {}", limit.words),
          .reference = clay                 ? "c / (gamma z sin cos)"
                       : limit.pressure < 1 ? "gamma' sin(phi) / gamma_sat"
                                            : "sin(phi), without dilation",
          .resolution = metres(limit.spacing)},
         fmt::format("rests at 99 %, flows at {:g} %", 100 * beyond), clay ? "1.5 %" : "1 %");
  }
}
