#include "app/staged_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include "solver/output/sheet_frames.hpp"

namespace porosph::app {
namespace {

constexpr std::array<const char*, 5> endings{"time", "rest", "failure", "unstable", "interrupted"};

std::string ending(const RunOutcome& outcome) {
  if (outcome.failed) return "failure";
  switch (outcome.status) {
    case RunStatus::completed:
      return "time";
    case RunStatus::equilibrium:
      return "rest";
    case RunStatus::unstable:
      return "unstable";
    case RunStatus::interrupted:
      break;
  }
  return "interrupted";
}

/// The numbers of a stage that has ended; its name is the case's.
void visit_stage(StateArchive& state, Summary::Stage& stage) {
  auto how = static_cast<std::int64_t>(std::ranges::find(endings, stage.ended) - endings.begin());
  state.value("stage_ended", how);
  if (how < 0 || how >= std::ssize(endings))
    throw StateError("the saved state has a stage that ended in no way");
  stage.ended = endings[how];
  state.value("stage_start", stage.start);
  state.value("stage_time", stage.time);
  state.value("stage_steps", stage.steps);
  state.value("stage_particles", stage.particles);
  state.value("stage_unbalanced", stage.unbalanced_force_ratio);
  state.value("stage_displacement", stage.largest_displacement);
}

void visit_footings(StateArchive& state, const std::vector<FootingCase>& all, Summary::Stage& stage) {
  for (const FootingCase& footing : all) {
    bool is_there = stage.footings.contains(footing.name);
    state.value("stage_footing", is_there);
    if (!is_there) continue;
    Summary::Footing& f = stage.footings[footing.name];
    for (double* value : {&f.force, &f.shear, &f.settlement, &f.width}) state.value("footing", *value);
  }
}

void visit_sheets(StateArchive& state, const std::vector<SheetCase>& all, Summary::Stage& stage) {
  for (const SheetCase& sheet : all) {
    bool is_there = stage.sheets.contains(sheet.name);
    state.value("stage_sheet", is_there);
    if (!is_there) continue;
    Summary::Sheet& s = stage.sheets[sheet.name];
    for (double* value : {&s.moment, &s.shear, &s.axial, &s.displacement}) state.value("sheet", *value);
  }
}

void visit_safety(StateArchive& state, std::optional<Summary::Safety>& safety) {
  bool is_there = safety.has_value();
  state.value("stage_safety", is_there);
  if (!is_there) return safety.reset();
  if (state.restoring()) safety = Summary::Safety{};
  state.value("stable_at", safety->stable_at);
  state.value("fails_at", safety->fails_at);
  state.value("limit_equilibrium", safety->limit_equilibrium);
  std::vector<char> note(safety->note.begin(), safety->note.end());
  std::int64_t length = std::ssize(note);
  state.value("note_length", length);
  if (length < 0 || length > 10'000) throw StateError("the saved state has a note that is none");
  note.resize(static_cast<std::size_t>(length));
  state.array("note", note);
  safety->note.assign(note.begin(), note.end());
}

void visit_probes(StateArchive& state, const std::vector<ProbeCase>& probes, Summary::Stage& stage) {
  for (const ProbeCase& probe : probes) {
    Summary::Probe& p = stage.probes[probe.name];
    p.x = probe.position.x(), p.y = probe.position.y();
    for (const std::string& quantity : probe_quantities()) state.value(quantity, p.values[quantity]);
  }
}

}  // namespace

std::map<std::string, Summary::Probe> probe_readings(const Simulation& s) {
  std::map<std::string, Summary::Probe> readings;
  for (const Probe& probe : s.probes()) {
    Summary::Probe& p = readings[probe.name()];
    p.x = probe.start().x(), p.y = probe.start().y();
    const std::vector<double> values = probe.read(s.model().particles).values();
    for (std::size_t i = 0; i < values.size(); ++i) p.values[probe_quantities()[i]] = values[i];
  }
  return readings;
}

std::map<std::string, Summary::Footing> footing_readings(Simulation& s) {
  std::map<std::string, Summary::Footing> readings;
  if (!s.footings().empty()) s.accelerations();  // for the forces at this instant
  for (const Footing& f : s.footings())
    readings[f.name()] = {.force = f.force(),
                          .shear = f.shear(),
                          .settlement = f.settlement(s.model().particles),
                          .width = f.width()};
  return readings;
}

StagedRun::StagedRun(const Case& scene, const HandedOver* state) : scene_(scene), plan_(scene) {
  begin({.time = 0, .state = state});
}

void StagedRun::begin(const Beginning& beginning) {
  simulation_ = std::make_unique<Simulation>(plan_.scene(), beginning);
}

void StagedRun::end(const RunOutcome& outcome, std::optional<Summary::Safety> safety) {
  if (!has_stages()) return;
  Simulation& s = *simulation_;
  ended_.push_back(
      {.name = plan_.name(),
       .ended = ending(outcome),
       .start = s.start_time(),
       .time = s.time(),
       .steps = s.step(),
       .particles = static_cast<std::int64_t>(s.model().particles.size()),
       .unbalanced_force_ratio = s.showable() ? s.unbalanced_force_ratio() : std::nan(""),
       .largest_displacement = s.showable() ? s.largest_displacement() : std::nan(""),
       .probes = probe_readings(s),
       .footings = s.showable() ? footing_readings(s) : std::map<std::string, Summary::Footing>(),
       .sheets = s.showable() ? sheet_readings(s) : std::map<std::string, Summary::Sheet>(),
       .safety = std::move(safety)});
}

bool StagedRun::goes_on() const {
  return has_stages() && !plan_.is_last() && (ended_.back().ended == "time" || ended_.back().ended == "rest");
}

void StagedRun::go_on() {
  const HandedOver state = simulation_->hand_over();
  const double time = simulation_->time();
  if (const auto issues = plan_.go_on(time); !issues.empty())
    throw std::runtime_error(fmt::format("key '{}': {}", issues.front().key, issues.front().message));
  begin({.time = time, .state = &state, .reset_displacements = plan_.resets_displacements()});
}

void StagedRun::visit(StateArchive& state) {
  auto count = static_cast<std::int64_t>(plan_.stage());  // of those before the present one
  state.value("stages_ended", count);
  if (count < 0 || count > std::ssize(scene_.stages))
    throw StateError("the saved state has more stages than the case");
  if (state.restoring()) ended_.assign(static_cast<std::size_t>(count), {}), plan_ = StagePlan(scene_);
  for (Summary::Stage& stage : std::span(ended_).first(static_cast<std::size_t>(count))) {
    visit_stage(state, stage);
    visit_probes(state, scene_.probes, stage);
    visit_footings(state, scene_.footings, stage);
    visit_sheets(state, scene_.sheets, stage);
    visit_safety(state, stage.safety);
    if (!state.restoring()) continue;
    stage.name = plan_.name();
    if (!plan_.go_on(stage.time).empty()) throw StateError("the saved state is not of the case's stages");
  }
  if (state.restoring() && count > 0) begin({.time = ended_.back().time});
  simulation_->visit(state);
}

std::int64_t StagedRun::steps() const {
  const bool present_is_noted = !ended_.empty() && ended_.size() > plan_.stage();
  std::int64_t sum = present_is_noted ? 0 : simulation_->step();
  for (const Summary::Stage& stage : ended_) sum += stage.steps;
  return sum;
}

std::int64_t StagedRun::particle_steps() const {
  const bool present_is_noted = !ended_.empty() && ended_.size() > plan_.stage();
  std::int64_t sum =
      present_is_noted ? 0 : simulation_->step() * std::ssize(simulation_->model().particles.position);
  for (const Summary::Stage& stage : ended_) sum += stage.steps * stage.particles;
  return sum;
}

}  // namespace porosph::app
