#include "solver/case/check_stages.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/case/safety_obstacle.hpp"
#include "solver/case/shapes.hpp"
#include "solver/case/stages.hpp"
#include "solver/space/place_text.hpp"

namespace porosph {
namespace {

using Issues = std::vector<CaseIssue>;

Issues check_settings_of_stages(const Case& c) {
  Issues issues;
  const auto key = [](std::size_t i, std::string_view name) { return fmt::format("stage[{}].{}", i, name); };
  for (std::size_t i = 0; i < c.stages.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      if (!c.stages[i].name.empty() && c.stages[i].name == c.stages[j].name)
        issues.push_back({key(i, "name"), fmt::format("is the name of stage[{}] too", j)});
    if (c.stages[i].name == "start")
      issues.push_back({key(i, "name"), "is what the part of the run before the first stage is called"});
    for (std::size_t k = 0; k < c.stages[i].excavate_within.size(); ++k)
      if (const std::string fault = outline_fault(c.stages[i].excavate_within[k]); !fault.empty())
        issues.push_back({key(i, fmt::format("excavate_within[{}]", k)), fault});
  }
  if (c.water.flows_over_time())
    issues.push_back(
        {"stage[0]", fmt::format("water.mode = \"{}\" cannot be combined with stages: it must be "
                                 "\"still\" or \"steady\"",
                                 name(c.water.mode))});
  if (c.reference != Reference::none) issues.push_back({"reference", "is for a case without stages"});
  for (std::size_t i = 0; i < c.soils.size(); ++i)
    if (c.soils[i].angular_velocity != 0 || c.soils[i].bending_velocity != 0)
      issues.push_back(
          {fmt::format("soil[{}]", i), "an initial rotation or vibration cannot be combined with stages"});
  return issues;
}

/// All soils and probes together; boundaries, loads and water are matters of each stage.
Issues check_together(const Case& scene) {
  Case all = scene;
  all.stages.clear(), all.boundaries.clear(), all.loads.clear(), all.footings.clear(), all.sheets.clear();
  all.water.stretches.clear(), all.water.level_over_time.clear(), all.water.faces.clear();
  all.water.mode = WaterMode::still;
  all.water.drains.clear(), all.sections.clear();
  all.loading.gravity_applied = false;
  all.time.end = latest_end(scene);
  return check_geometry(all);
}

/// Pieces that outlines of excavations leave must hold particles.
Issues check_pieces(const Case& scene, const StagePlan& plan) {
  const auto cuts = [](const StageCase& stage) { return !stage.excavate_within.empty(); };
  const auto first = std::ranges::find_if(scene.stages, cuts) - scene.stages.begin();
  Issues issues;
  for (const SoilCase& piece : plan.whole().soils)
    if (const double width = thickness(piece.polygon); width < scene.particles.spacing * (1 - 1e-9))
      issues.push_back({fmt::format("stage[{}].excavate_within", first),
                        fmt::format("the outlines cut soil '{}' into pieces of which one, at {}, is "
                                    "{:.4g} m thick, less than particles.spacing = {} m",
                                    scene.soils[piece.id].name, place_text(piece.polygon[0]), width,
                                    scene.particles.spacing)});
  return issues;
}

/// A stage by itself, with the probes that are in its soils.
Issues check_one(Case stage) {
  std::erase_if(stage.probes, [&](const ProbeCase& probe) {
    return std::ranges::none_of(stage.soils,
                                [&](const SoilCase& s) { return distance(probe.position, s) <= 0; });
  });
  return check_geometry(stage);
}

/// The key in the file of "soil[1].polygon" in the first stage, where soils that come later are missing.
std::string key_in_file(const std::string& key, const Case& stage, const Case& file) {
  const auto number = [&](std::string_view list, auto&& place) {
    if (!key.starts_with(list) || key.size() <= list.size() || key[list.size()] != '[') return std::string();
    const auto end = key.find(']');
    const std::size_t i = std::stoul(key.substr(list.size() + 1, end - list.size() - 1));
    return fmt::format("{}[{}{}", list, place(i), key.substr(end));
  };
  const std::string soil = number("soil", [&](std::size_t i) { return stage.soils[i].id; });
  if (!soil.empty()) return soil;
  const std::string load = number("load", [&](std::size_t i) {
    return std::ranges::find(file.loads, stage.loads[i].name, &LoadCase::name) - file.loads.begin();
  });
  if (!load.empty()) return load;
  const std::string footing = number("footing", [&](std::size_t i) {
    return std::ranges::find(file.footings, stage.footings[i].name, &FootingCase::name) -
           file.footings.begin();
  });
  if (!footing.empty()) return footing;
  const std::string sheet = number("sheet", [&](std::size_t i) {
    return std::ranges::find(file.sheets, stage.sheets[i].name, &SheetCase::name) - file.sheets.begin();
  });
  if (!sheet.empty()) return sheet;
  const std::string boundary = number("boundary", [&](std::size_t i) {
    const BoundaryCase& b = stage.boundaries[i];
    return std::ranges::find_if(file.boundaries,
                                [&](const auto& o) { return o.from == b.from && o.to == b.to; }) -
           file.boundaries.begin();
  });
  return boundary.empty() ? key : boundary;
}

}  // namespace

Issues check_stages(const Case& scene) {
  Issues issues = check_settings_of_stages(scene);
  if (!issues.empty()) return issues;
  issues = check_together(scene);
  if (!issues.empty()) return issues;
  StagePlan plan(scene);
  issues = check_pieces(scene, plan);
  if (!issues.empty()) return issues;
  for (CaseIssue& issue : check_one(plan.scene()))
    issues.push_back({key_in_file(issue.key, plan.scene(), scene), issue.message});
  for (std::size_t i = 0; i < scene.stages.size() && issues.empty(); ++i) {
    issues = plan.go_on(plan.scene().time.end);
    if (!issues.empty()) break;
    for (const CaseIssue& issue : check_one(plan.scene()))
      issues.push_back({fmt::format("stage[{}]", i),
                        fmt::format("in stage '{}' {}: {}", plan.name(),
                                    key_in_file(issue.key, plan.scene(), scene), issue.message)});
    if (!scene.stages[i].safety || !issues.empty()) continue;
    if (const std::string obstacle = safety_obstacle(plan.scene()); !obstacle.empty())
      issues.push_back({fmt::format("stage[{}].safety", i), obstacle});
  }
  return issues;
}

}  // namespace porosph
