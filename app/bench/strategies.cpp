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
    return {"time.courant=0.2", "loading.damping=0.002", fmt::format("time.end={}", scene.end),
            "stop.unbalanced_force_ratio=0"};
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
      {"foundation", "foundation.toml", true, column, {}, 4, "foundation_fast.toml"},
      {"embankment", "embankment.toml", false, 0.22, {}, 4, "embankment_fast.toml"},
      // A thousand times as stiff, it strains as little as finite elements assume, at the same stress.
      {"stiff embankment", "embankment.toml", false, 0.22, {"soil.0.youngs_modulus=15e9"}, 0.13},
  };
  return all;
}

std::string Plan::file() const { return strategy == fast_strategy ? scene.fast_file : scene.file; }

std::vector<std::string> Plan::overrides() const {
  if (strategy == fast_strategy) return {fmt::format("particles.spacing={:.17g}", spacing)};
  std::vector<std::string> all = strategy_overrides(scene, strategy, spacing);
  all.insert(all.end(), scene.overrides.begin(), scene.overrides.end());
  all.push_back("formulation.motion=" + (plain ? "proposed" : form));
  all.push_back(fmt::format("particles.spacing={:.17g}", spacing));
  return all;
}

std::vector<Plan> plans(bool quick) {
  const Scene &column = scenes()[0], &foundation = scenes()[1], &embankment = scenes()[2],
              &stiff = scenes()[3];
  std::vector<Plan> all;
  if (quick) {
    for (const Scene& scene : {column, foundation}) {
      add(all, scene, plain_form, paper_strategy, {0.5});
      add(all, scene, consistent_form, paper_strategy, {0.5});
      for (const char* form : {"consistent", "proposed"}) add(all, scene, form, rest_strategy, {0.5, 0.2});
    }
    add(all, column, consistent_form, refresh_strategy, {0.2});
    add(all, embankment, consistent_form, rest_strategy, {0.4});
    for (const Scene& scene : {foundation, embankment})
      add(all, scene, consistent_form, fast_strategy, {0.5});
    return all;
  }
  add(all, column, consistent_form, refresh_strategy, {0.2});
  add(all, column, consistent_form, rest_strategy, {0.2});
  add(all, foundation, consistent_form, rest_strategy, {0.5, 0.25, 0.2, 10. / 60});
  add(all, embankment, consistent_form, rest_strategy, {0.4, 0.2});
  add(all, foundation, consistent_form, fast_strategy, {1, 0.5, 0.25});
  add(all, embankment, consistent_form, fast_strategy, {0.8, 0.4, 0.2});
  add(all, foundation, plain_form, paper_strategy, {0.2});
  add(all, embankment, plain_form, paper_strategy, {0.2});
  add(all, stiff, consistent_form, rest_strategy, {0.4, 0.2});
  add(all, foundation, consistent_form, rest_strategy, {0.1});
  add(all, embankment, consistent_form, rest_strategy, {0.1});
  add(all, stiff, consistent_form, rest_strategy, {0.1});
  add(all, column, plain_form, paper_strategy, {0.5, 0.2});
  add(all, column, consistent_form, rest_strategy, {0.5, 0.25, 0.1, 0.05});
  for (const char* form : {"consistent", "proposed", "conventional"}) {
    if (form != consistent_form) add(all, column, form, rest_strategy, {0.5, 0.25, 0.2, 0.1, 0.05});
    add(all, column, form, paper_strategy, {0.5, 0.2});
  }
  add(all, foundation, consistent_form, paper_strategy, {0.5, 0.2});
  add(all, embankment, consistent_form, paper_strategy, {0.4, 0.2});
  for (const char* form : {"proposed", "conventional"}) {
    add(all, foundation, form, rest_strategy, {0.5, 0.25, 0.2});
    add(all, foundation, form, paper_strategy, {0.5, 0.2});
    add(all, embankment, form, rest_strategy, {0.4, 0.2});
    add(all, embankment, form, paper_strategy, {0.4, 0.2});
  }
  add(all, foundation, plain_form, paper_strategy, {0.5});
  add(all, embankment, plain_form, paper_strategy, {0.4});
  add(all, foundation, consistent_form, rest_strategy, {0.05});
  add(all, foundation, plain_form, paper_strategy, {0.1});
  add(all, embankment, plain_form, paper_strategy, {0.1});
  return all;
}

}  // namespace porosph::bench
