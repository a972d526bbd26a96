#include "app/bench/strategies.hpp"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

#include "app/bench/work_precision.hpp"

namespace porosph::bench {
namespace {

constexpr double large_courant = 0.9;

std::vector<std::string> strategy_overrides(const Scene& scene, const std::string& strategy, double spacing) {
  if (strategy == paper_strategy)
    return {"time.courant=0.2", "loading.damping=0.002", "time.end=4", "stop.unbalanced_force_ratio=0"};
  std::vector<std::string> overrides = {
      fmt::format("time.courant={}", large_courant),
      fmt::format("loading.damping={:.6g}", scene.critical_damping * large_courant * spacing), "time.end=4",
      "stop.unbalanced_force_ratio=1e-4"};
  if (strategy == refresh_strategy)
    overrides.push_back("formulation.refresh_strain=0");
  else if (strategy != rest_strategy)
    throw std::logic_error("unknown strategy " + strategy);
  return overrides;
}

void add(std::vector<Plan>& all, const Scene& scene, const std::string& form, const std::string& strategy,
         const std::vector<double>& spacings) {
  for (double spacing : spacings)
    all.push_back({.scene = scene,
                   .form = form,
                   .strategy = strategy,
                   .spacing = spacing,
                   .plain = form == plain_form});
}

}  // namespace

const std::vector<Scene>& scenes() {
  // c_d = 2 omega = pi c_p / H for a column of H = 10 m, and with dt = C h / c_p, h = 1.2 dx, xi = c_d dt.
  constexpr double column = std::numbers::pi * 1.2 / 10;
  static const std::vector<Scene> all = {
      {"column", "verification/column.toml", true, column},
      {"foundation", "foundation.toml", true, column},
      {"embankment", "embankment.toml", false, 0.17},
  };
  return all;
}

std::vector<std::string> Plan::overrides() const {
  std::vector<std::string> all = strategy_overrides(scene, strategy, spacing);
  all.push_back("formulation.motion=" + (plain ? "proposed" : form));
  all.push_back(fmt::format("particles.spacing={:.17g}", spacing));
  return all;
}

std::vector<Plan> plans(bool quick) {
  const Scene &column = scenes()[0], &foundation = scenes()[1], &embankment = scenes()[2];
  std::vector<Plan> all;
  if (quick) {
    for (const Scene& scene : {column, foundation}) {
      add(all, scene, plain_form, paper_strategy, {0.5});
      add(all, scene, consistent_form, paper_strategy, {0.5});
      for (const char* form : {"consistent", "proposed"}) add(all, scene, form, rest_strategy, {0.5, 0.2});
    }
    add(all, column, consistent_form, refresh_strategy, {0.2});
    add(all, embankment, consistent_form, rest_strategy, {0.5});
    return all;
  }
  add(all, foundation, plain_form, paper_strategy, {0.2});
  add(all, foundation, consistent_form, rest_strategy, {0.5, 0.25, 0.2, 10. / 60, 0.1});
  add(all, column, consistent_form, refresh_strategy, {0.2});
  add(all, embankment, plain_form, paper_strategy, {0.2});
  add(all, embankment, consistent_form, rest_strategy, {0.5, 0.25, 0.2, 0.1});
  add(all, column, plain_form, paper_strategy, {0.5, 0.2});
  for (const char* form : {"consistent", "proposed", "conventional"}) {
    add(all, column, form, rest_strategy, {0.5, 0.25, 0.2, 0.1, 0.05});
    add(all, column, form, paper_strategy, {0.5, 0.2});
  }
  add(all, foundation, consistent_form, paper_strategy, {0.5, 0.2});
  add(all, embankment, consistent_form, paper_strategy, {0.5, 0.2});
  for (const char* form : {"proposed", "conventional"})
    for (const Scene& scene : {foundation, embankment}) {
      add(all, scene, form, rest_strategy, {0.5, 0.25, 0.2});
      add(all, scene, form, paper_strategy, {0.5, 0.2});
    }
  add(all, foundation, plain_form, paper_strategy, {0.5});
  add(all, embankment, plain_form, paper_strategy, {0.5});
  add(all, foundation, consistent_form, rest_strategy, {0.05});
  add(all, foundation, plain_form, paper_strategy, {0.1});
  add(all, embankment, plain_form, paper_strategy, {0.1});
  return all;
}

}  // namespace porosph::bench
