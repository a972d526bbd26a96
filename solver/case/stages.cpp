#include "solver/case/stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <set>
#include <span>
#include <stdexcept>

#include "solver/case/change_settings.hpp"
#include "solver/case/check_boundaries.hpp"
#include "solver/case/shapes.hpp"

namespace porosph {
namespace {

using Issues = std::vector<CaseIssue>;

std::string item(const std::string& key, std::string_view list, std::size_t i) {
  return fmt::format("{}.{}[{}]", key, list, i);
}

template <class T>
std::string names_of(const std::vector<T>& items) {
  std::string names;
  for (const T& item : items)
    if (!item.name.empty()) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", item.name);
  return names.empty() ? "none" : names;
}

template <class T>
int find_named(const std::vector<T>& items, const std::string& name) {
  const auto found = std::ranges::find(items, name, &T::name);
  return found == items.end() || name.empty() ? -1 : static_cast<int>(found - items.begin());
}

/// Whether what is called so is absent until a stage brings it: the first stage that names it does so.
bool begins_absent(const std::vector<StageCase>& stages, const std::string& name,
                   std::vector<std::string> StageCase::*going, std::vector<std::string> StageCase::*coming) {
  const auto in = [&](const std::vector<std::string>& names) {
    return std::ranges::find(names, name) != names.end();
  };
  for (const StageCase& stage : stages) {
    if (in(stage.*going)) return false;
    if (in(stage.*coming)) return true;
  }
  return false;
}

std::string key_of(const std::string& setting) {
  return boost::trim_copy(setting.substr(0, setting.find('=')));
}

/// What stands against setting a key in a stage; empty if nothing.
std::string setting_fault(const std::string& key) {
  const std::string_view k = key;
  const auto ends_with_one_of = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::any_of(names, [&](std::string_view n) { return k.ends_with(n); });
  };
  const bool known = k.starts_with("soil.") || k.starts_with("water.") || k.starts_with("loading.") ||
                     k.starts_with("load.") || k.starts_with("footing.") || k.starts_with("sheet.") ||
                     k.starts_with("formulation.") || k.starts_with("stop.") || k == "time.courant";
  if (!known)
    return "a stage may set keys of soil, water, loading, load, footing, sheet, formulation and stop, and "
           "time.courant";
  if (k.starts_with("soil.") && ends_with_one_of({".name", ".polygon", ".holes", ".velocity",
                                                  ".angular_velocity", ".bending_velocity"}))
    return "a stage cannot move or rename a soil: see excavate and fill";
  if (k.starts_with("load.") && ends_with_one_of({".name", ".from", ".to"}))
    return "a stage cannot move or rename a load: declare another, and see load_on and load_off";
  if (k.starts_with("footing.") && ends_with_one_of({".name", ".from", ".to"}))
    return "a stage cannot move or rename a footing: declare another, and see footing_on and footing_off";
  if (k.starts_with("sheet.") && ends_with_one_of({".name", ".from", ".to"}))
    return "a stage cannot move or rename a sheet: declare another, and see sheet_on and sheet_off";
  if (k == "formulation.motion") return "one form of the motion equation holds throughout";
  if (k == "loading.k0_stress" || k == "loading.gravity")
    return "this holds from the start: see fill_stress for soil that is placed";
  if (k == "water.mode") return "water that flows steadily, or stands, does so throughout";
  return "";
}

/// Linear between the times, constant before and after.
double value_at(const std::vector<Point>& course, double time) {
  const auto next = std::ranges::find_if(course, [&](const Point& p) { return p.x() > time; });
  if (next == course.begin()) return next->y();
  const Point before = *(next - 1);
  if (next == course.end()) return before.y();
  return before.y() + (next->y() - before.y()) * (time - before.x()) / (next->x() - before.x());
}

void shift(std::vector<Point>& over_time, double time) {
  for (Point& p : over_time) p.x() += time;
}

}  // namespace

double latest_end(const Case& scene) {
  double end = scene.time.end;
  for (const StageCase& stage : scene.stages) end += stage.duration;
  return end;
}

Case last_stage(const Case& scene) {
  StagePlan plan(scene);
  while (!plan.is_last()) plan.go_on(plan.scene().time.end);
  return plan.scene();
}

void require_plain(const Case& scene, std::string_view who) {
  if (!scene.stages.empty())
    throw std::runtime_error(
        fmt::format("{} is for a case without stages: [[stage]] is what porosph run and check follow", who));
  if (!scene.start_from.empty())
    throw std::runtime_error(
        fmt::format("{} is for a case that starts by itself: start_from is what porosph run follows", who));
}

StagePlan::StagePlan(const Case& scene) : file_(scene), stages_(scene.stages) {
  if (stages_.empty()) {
    current_ = scene;
    return;
  }
  file_.stages.clear();
  cut_soils();
  find_absent();
  auto whole = std::make_shared<Case>(file_);
  whole->soils = soils(true);
  plan_ = whole;
  make_current(file_.time.end);
}

/// Along all outlines within which stages excavate.
void StagePlan::cut_soils() {
  const double least = 1e-6 * file_.particles.spacing * file_.particles.spacing;
  for (std::size_t i = 0; i < file_.soils.size(); ++i) {
    SoilCase& soil = file_.soils[i];
    std::vector<Piece> pieces = {{static_cast<int>(i), soil, {}}};
    int area = 0;
    for (const StageCase& stage : stages_)
      for (const Polygon& outline : stage.excavate_within) {
        std::vector<Piece> cut;
        for (const Piece& piece : pieces)
          for (const bool inside : {false, true})
            for (SoilCase& part : parts_of(piece.shape, outline, inside, least)) {
              cut.push_back({piece.soil, std::move(part), piece.areas});
              if (inside) cut.back().areas.push_back(area);
            }
        pieces = std::move(cut);
        ++area;
      }
    if (pieces.size() > 1 && soil.strength.growth > 0 && !(soil.strength.level < never))
      soil.strength.level = highest_point(soil);  // that of the whole soil, for its pieces
    for (std::size_t k = 1; k < pieces.size(); ++k)
      pieces[k].shape.name = fmt::format("{}-{}", soil.name, k + 1);
    pieces_.insert(pieces_.end(), pieces.begin(), pieces.end());
  }
}

void StagePlan::find_absent() {
  for (Piece& piece : pieces_)
    piece.present =
        !begins_absent(stages_, file_.soils[piece.soil].name, &StageCase::excavate, &StageCase::fill);
  for (const LoadCase& load : file_.loads)
    load_on_.push_back(!begins_absent(stages_, load.name, &StageCase::load_off, &StageCase::load_on));
  for (const FootingCase& footing : file_.footings)
    footing_on_.push_back(
        !begins_absent(stages_, footing.name, &StageCase::footing_off, &StageCase::footing_on));
  for (const SheetCase& sheet : file_.sheets)
    sheet_on_.push_back(!begins_absent(stages_, sheet.name, &StageCase::sheet_off, &StageCase::sheet_on));
  for (const BoundaryCase& b : file_.boundaries)
    support_on_.push_back(b.name.empty() ||
                          !begins_absent(stages_, b.name, &StageCase::support_off, &StageCase::support_on));
}

std::vector<SoilCase> StagePlan::soils(bool all) const {
  std::vector<SoilCase> soils;
  for (const Piece& piece : pieces_) {
    if (!all && !piece.present) continue;
    SoilCase soil = file_.soils[piece.soil];
    soil.name = piece.shape.name, soil.polygon = piece.shape.polygon, soil.holes = piece.shape.holes;
    soil.id = piece.soil;
    soils.push_back(std::move(soil));
  }
  return soils;
}

void StagePlan::make_current(double end) {
  Case c = file_;
  c.plan = plan_;
  c.soils = soils(false);
  c.loads.clear(), c.footings.clear(), c.sheets.clear(), c.boundaries.clear();
  for (std::size_t i = 0; i < file_.loads.size(); ++i)
    if (load_on_[i]) c.loads.push_back(file_.loads[i]);
  for (std::size_t i = 0; i < file_.footings.size(); ++i)
    if (footing_on_[i]) c.footings.push_back(file_.footings[i]);
  for (std::size_t i = 0; i < file_.sheets.size(); ++i)
    if (sheet_on_[i]) c.sheets.push_back(file_.sheets[i]);
  for (std::size_t i = 0; i < file_.boundaries.size(); ++i)
    if (support_on_[i] && lies_on_soil(c, file_.boundaries[i])) c.boundaries.push_back(file_.boundaries[i]);
  c.time.end = end;
  c.all_from_start =
      file_.start_from.empty() && std::ranges::all_of(std::span(stages_).first(stage_),
                                                      [](const StageCase& s) { return s.fill.empty(); });
  if (stage_ > 0) {
    c.loading.k0_stress = stages_[stage_ - 1].fill_stress == FillStress::k0;
    c.start_from.clear();
  }
  current_ = std::move(c);
}

Issues StagePlan::go_on(double time) {
  const StageCase& stage = stages_[stage_];
  const std::string key = fmt::format("stage[{}]", stage_);
  Issues issues;
  change_settings(stage, key, time, issues);
  if (!issues.empty()) return issues;
  change_soils(stage, key, issues);
  change_loads(stage, key, time, issues);
  change_footings(stage, key, time, issues);
  change_sheets(stage, key, issues);
  change_supports(stage, key, issues);
  if (!issues.empty()) return issues;
  ++stage_;
  make_current(time + stage.duration);
  return issues;
}

void StagePlan::change_settings(const StageCase& stage, const std::string& key, double time, Issues& issues) {
  if (stage.set.empty()) return;
  std::set<std::string> keys;
  for (std::size_t i = 0; i < stage.set.size(); ++i) {
    keys.insert(key_of(stage.set[i]));
    if (const std::string fault = setting_fault(key_of(stage.set[i])); !fault.empty())
      issues.push_back({item(key, "set", i), fault});
  }
  if (!issues.empty()) return;
  std::vector<SettingFault> faults;
  file_ = with_settings(file_, stage.set, faults);
  for (const SettingFault& fault : faults)
    issues.push_back({fault.setting < 0 ? key + ".set" : item(key, "set", fault.setting), fault.message});
  if (!issues.empty()) return;
  if (keys.contains("water.level_over_time")) shift(file_.water.level_over_time, time);
  const auto shift_set = [&](std::string_view list, auto& items) {
    for (std::size_t i = 0; i < items.size(); ++i)
      if (keys.contains(fmt::format("{}.{}.over_time", list, items[i].name)) ||
          keys.contains(fmt::format("{}.{}.over_time", list, i)))
        shift(items[i].over_time, time);
  };
  shift_set("load", file_.loads);
  shift_set("footing", file_.footings);
}

void StagePlan::change_soils(const StageCase& stage, const std::string& key, Issues& issues) {
  const auto of_soil = [&](const std::string& name) {
    std::vector<Piece*> pieces;
    for (Piece& piece : pieces_)
      if (file_.soils[piece.soil].name == name) pieces.push_back(&piece);
    return pieces;
  };
  const auto change = [&](std::string_view list, const std::vector<std::string>& names, bool present,
                          const char* fault) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::vector<Piece*> pieces = of_soil(names[i]);
      const auto differs = [&](const Piece* piece) { return piece->present != present; };
      if (pieces.empty())
        issues.push_back(
            {item(key, list, i), fmt::format("no soil is called so: there are {}", names_of(file_.soils))});
      else if (std::ranges::none_of(pieces, differs))
        issues.push_back({item(key, list, i), fault});
      for (Piece* piece : pieces) piece->present = present;
    }
  };
  change("excavate", stage.excavate, false, "this soil is not there in this stage");
  for (std::size_t i = 0; i < stage.excavate_within.size(); ++i, ++areas_) {
    bool found = false;
    for (Piece& piece : pieces_)
      if (piece.present && std::ranges::find(piece.areas, areas_) != piece.areas.end())
        piece.present = false, found = true;
    if (!found)
      issues.push_back(
          {item(key, "excavate_within", i), "there is no soil within this outline in this stage"});
  }
  change("fill", stage.fill, true, "this soil is there already");
  if (std::ranges::none_of(pieces_, &Piece::present)) issues.push_back({key, "leaves no soil at all"});
}

namespace {

/// A load, footing or sheet that a stage switches on or off: its place among all, or -1 and what is wrong.
template <class T>
int place_of(const std::vector<T>& items, std::string_view what, const std::string& name,
             const std::vector<char>& is_on, bool on, const std::string& key, Issues& issues) {
  const int place = find_named(items, name);
  if (place >= 0 && static_cast<bool>(is_on[place]) != on) return place;
  if (place < 0)
    issues.push_back({key, fmt::format("no {} is called so: there are {}", what, names_of(items))});
  else
    issues.push_back(
        {key, fmt::format("this {} {}", what, on ? "acts already" : "does not act in this stage")});
  return -1;
}

/// The course of a load or footing that begins to act at a time, over `ramp` where that is not 0.
void begin_course(std::vector<Point>& course, double time, double ramp, std::string_view what,
                  const std::string& name, const std::string& key, Issues& issues) {
  if (ramp > 0 && !course.empty())
    issues.push_back({key + ".ramp", fmt::format("{} '{}' has an over_time of its own", what, name)});
  if (ramp > 0) course = {{0, 0}, {ramp, 1}};
  shift(course, time);
}

}  // namespace

void StagePlan::change_loads(const StageCase& stage, const std::string& key, double time, Issues& issues) {
  for (std::size_t i = 0; i < stage.load_on.size(); ++i) {
    const std::string& name = stage.load_on[i];
    const int load = place_of(file_.loads, "load", name, load_on_, true, item(key, "load_on", i), issues);
    if (load < 0) continue;
    load_on_[load] = true;
    begin_course(file_.loads[load].over_time, time, stage.ramp, "load", name, key, issues);
  }
  for (std::size_t i = 0; i < stage.load_off.size(); ++i) {
    const int load =
        place_of(file_.loads, "load", stage.load_off[i], load_on_, false, item(key, "load_off", i), issues);
    if (load < 0) continue;
    if (stage.ramp == 0) {
      load_on_[load] = false;
      continue;
    }
    std::vector<Point>& course = file_.loads[load].over_time;
    const double now = course.empty() ? 1 : value_at(course, time);
    course = {{time, now}, {time + stage.ramp, 0}};
  }
}

void StagePlan::change_footings(const StageCase& stage, const std::string& key, double time, Issues& issues) {
  for (std::size_t i = 0; i < stage.footing_on.size(); ++i) {
    const std::string& name = stage.footing_on[i];
    const int footing =
        place_of(file_.footings, "footing", name, footing_on_, true, item(key, "footing_on", i), issues);
    if (footing < 0) continue;
    footing_on_[footing] = true;
    begin_course(file_.footings[footing].over_time, time, stage.ramp, "footing", name, key, issues);
  }
  for (std::size_t i = 0; i < stage.footing_off.size(); ++i) {
    const int footing = place_of(file_.footings, "footing", stage.footing_off[i], footing_on_, false,
                                 item(key, "footing_off", i), issues);
    if (footing >= 0) footing_on_[footing] = false;
  }
}

void StagePlan::change_sheets(const StageCase& stage, const std::string& key, Issues& issues) {
  const auto change = [&](std::string_view list, const std::vector<std::string>& names, bool on) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const int sheet = place_of(file_.sheets, "sheet", names[i], sheet_on_, on, item(key, list, i), issues);
      if (sheet >= 0) sheet_on_[sheet] = on;
    }
  };
  change("sheet_on", stage.sheet_on, true);
  change("sheet_off", stage.sheet_off, false);
}

void StagePlan::change_supports(const StageCase& stage, const std::string& key, Issues& issues) {
  const auto change = [&](std::string_view list, const std::vector<std::string>& names, bool on) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      bool found = false, changed = false;
      for (std::size_t b = 0; b < file_.boundaries.size(); ++b) {
        if (names[i].empty() || file_.boundaries[b].name != names[i]) continue;
        found = true, changed |= static_cast<bool>(support_on_[b]) != on;
        support_on_[b] = on;
      }
      if (!found)
        issues.push_back({item(key, list, i),
                          fmt::format("no boundary is called so: there are {}", names_of(file_.boundaries))});
      else if (!changed)
        issues.push_back({item(key, list, i), on ? "this boundary is there already"
                                                 : "this boundary is not there in this stage"});
    }
  };
  change("support_off", stage.support_off, false);
  change("support_on", stage.support_on, true);
}

std::vector<std::string> StagePlan::changes() const {
  if (stage_ == 0) return {};
  const StageCase& s = stages_[stage_ - 1];
  std::vector<std::string> told;
  const auto tell = [&](const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) told.push_back(fmt::format("{} {}", what, fmt::join(names, ", ")));
  };
  tell("removes", s.excavate);
  if (!s.excavate_within.empty())
    told.push_back(s.excavate_within.size() == 1
                       ? std::string("excavates within an outline")
                       : fmt::format("excavates within {} outlines", s.excavate_within.size()));
  tell(s.fill_stress == FillStress::k0 ? "places, under K0 stress," : "places", s.fill);
  tell("loads with", s.load_on), tell("unloads", s.load_off);
  tell("places footing", s.footing_on), tell("lifts footing", s.footing_off);
  tell("places sheet", s.sheet_on), tell("pulls sheet", s.sheet_off);
  tell("adds boundary", s.support_on), tell("removes boundary", s.support_off);
  tell("sets", s.set);
  if (s.reset_displacements) told.push_back("displacements count from here");
  if (s.safety) told.push_back("the factor of safety is found at its end");
  return told;
}

}  // namespace porosph
