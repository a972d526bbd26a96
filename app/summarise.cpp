#include "app/summarise.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <sys/resource.h>

#include <cmath>
#include <limits>

#include "app/check_by_fem.hpp"
#include "app/colour.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/inertia.hpp"
#include "solver/output/sheet_frames.hpp"
#include "solver/run/monitor/zigzag.hpp"
#include "solver/run/reference_errors.hpp"
#include "solver/space/place_text.hpp"
#include "solver/sph/consistent/consistent.hpp"
#include "vtk_io/run_folder/safety_files.hpp"

namespace porosph::app {
namespace {

std::map<std::string, std::string> skipped_work(const Simulation& s) {
  const Case& c = s.scene();
  const FormulationCase& f = c.formulation;
  const Dynamics::Counts& counts = s.dynamics().counts;
  std::map<std::string, std::string> skipped;
  if (!c.water.present() && !c.water.flows()) skipped["pore_pressure"] = "the scene is dry";
  if (c.soils.size() == 1) skipped["moduli_per_particle"] = "there is one soil";
  if (!f.kernel_correction) skipped["kernel_correction"] = "off";
  if (f.artificial_viscosity_alpha == 0 && f.artificial_viscosity_beta == 0)
    skipped["artificial_viscosity"] = "alpha and beta are zero";
  if (f.artificial_stress == 0) skipped["artificial_stress"] = "its strength is zero";
  if (f.zero_energy_control == 0) skipped["zero_energy_control"] = "its strength is zero";
  if (f.motion == Motion::consistent && bulk_viscosity_of(f, s.model()) == 0)
    skipped["bulk_viscosity"] = f.bulk_viscosity == 0 ? "its strength is zero" : "soil yields";
  if (f.motion != Motion::consistent) skipped["bulk_viscosity"] = "its strength is zero";
  if (c.loading.damping == 0 && !c.loading.adaptive_damping) skipped["damping"] = "xi is zero";
  skipped["kernel_gradients"] = fmt::format("made {} times in {} steps", counts.refreshes, s.step());
  if (f.motion == Motion::consistent)
    skipped["closed_gradients"] =
        f.closed_gradients ? fmt::format("needed {} times of {}", counts.closures, counts.refreshes) : "off";
  skipped["neighbour_search"] = fmt::format("{} times in {} steps", counts.searches, s.step());
  return skipped;
}

std::string tell(const Summary::Seepage& seepage) {
  std::string text = "water through the faces";
  for (std::size_t i = 0; i < seepage.through_faces.size(); ++i)
    text += fmt::format("{} [{}] {:.4g}", i == 0 ? "" : ",", i, seepage.through_faces[i]);
  for (const auto& [name, discharge] : seepage.sections)
    text += fmt::format(", section {} {:.4g}", name, discharge);
  return text + fmt::format(" m2/s, out of balance by {:.0e} of what enters\n", std::abs(seepage.imbalance));
}

std::string tell(const Summary::Consolidation& c) {
  return fmt::format(
      "{} flow steps, {} pressure solves of {:.3g} iterations, {} sweeps of the soil; "
      "{:.4g} m2 of water have left, {:.0e} m2 are missing\n",
      c.flow_steps, c.pressure_solves,
      static_cast<double>(c.krylov_iterations) /
          static_cast<double>(std::max<std::int64_t>(1, c.pressure_solves)),
      c.soil_sweeps, c.drained, std::abs(c.imbalance));
}

std::string tell(const Summary::TransientSeepage& c) {
  return fmt::format(
      "{} flow steps, {} refused, of {:.3g} Newton steps and {:.3g} iterations; {} sweeps of the soil\n"
      "{:.4g} m2 of water have entered, {:.4g} m2 left, the soil gained {:.4g} m2; out of balance by "
      "{:.0e}\n",
      c.flow_steps, c.refused_steps,
      static_cast<double>(c.newton_steps) / static_cast<double>(std::max<std::int64_t>(1, c.flow_steps)),
      static_cast<double>(c.krylov_iterations) / static_cast<double>(std::max<std::int64_t>(1, c.flow_steps)),
      c.soil_sweeps, c.entered, c.left, c.gained, std::abs(c.imbalance));
}

std::string tell(const Summary::WaterMotion& c) {
  std::string text = c.began > 0 ? fmt::format("equilibrium was lost at {:.6g} s; ", c.began) : "";
  text += fmt::format("{} steps with inertia", c.steps);
  if (c.krylov_iterations > 0)  // else no excess pressure arises
    text += fmt::format(
        ", {:.3g} iterations each for the pressure; {:.4g} m2 of water have left, {:.0e} m2 are missing",
        static_cast<double>(c.krylov_iterations) / static_cast<double>(c.steps), c.drained,
        std::abs(c.imbalance));
  return text + "\n";
}

std::string tell(const Summary::EnergyBudget& e) {
  const auto share = [&](double part) { return fmt::format("{:.1f} %", 100 * part / e.released); };
  std::string text = fmt::format(
      "{:.4g} J/m released: {} dissipated by the soil, {} by the zero-energy control, {} by walls that stop "
      "loose particles, {} by friction on walls, {} by the stress behind walls",
      e.released, share(e.plastic), share(e.control), share(e.contact), share(e.friction), share(e.walls));
  if (e.water != 0) text += fmt::format(", {} by the pore water", share(e.water));
  return text + fmt::format(", {} unaccounted for\n", share(e.unaccounted));
}

Summary::WaterMotion motion_summary(const Simulation& s) {
  const double failed_at = s.failed_at() < never ? s.failed_at() : 0;
  const DynamicWater* water = s.water_in_motion();
  if (water == nullptr) return {.began = failed_at, .steps = s.moves()};
  return {failed_at,
          water->counts().steps,
          water->counts().krylov_iterations,
          water->counts().renewals,
          water->drained(),
          water->imbalance(),
          water->misfit()};
}

Summary::TransientSeepage transient_summary(const Simulation& s) {
  const Richards& flow = s.seepage()->richards();
  const Richards::Balance balance = flow.balance();
  return {flow.counts().steps,
          flow.counts().refused,
          flow.counts().newton_steps,
          flow.counts().krylov_iterations,
          s.settling_sweeps(),
          balance.entered,
          balance.left,
          balance.gained,
          balance.error()};
}

std::string tell(const std::vector<Summary::Stage>& stages) {
  std::string text;
  const auto tell = [](const std::optional<Summary::Safety>& safety) -> std::string {
    if (!safety || (safety->stable_at == 0 && !std::isfinite(safety->fails_at))) return "";
    return fmt::format("  factor of safety {}{}\n", bracket_text(safety->stable_at, safety->fails_at),
                       safety->limit_equilibrium > 0
                           ? fmt::format("; limit equilibrium {:.3f}", safety->limit_equilibrium)
                           : "");
  };
  for (const Summary::Stage& stage : stages)
    text += fmt::format("stage '{}' from {:.6g} to {:.6g} s, ended by {}: {} particles, {:.4g} mm at most\n",
                        stage.name, stage.start, stage.time, stage.ended, stage.particles,
                        1e3 * stage.largest_displacement) +
            tell(stage.safety);
  return text;
}

/// What finite elements say at a probe, where they were computed.
std::string beside_finite_elements(const Summary& s, const std::string& probe) {
  if (!s.finite_elements || !s.finite_elements->probes.contains(probe)) return "";
  const auto& there = s.finite_elements->probes.at(probe);
  return fmt::format("; finite elements {:.3f} kPa, {:.3f} mm", there.at("EffectiveStress_YY") / 1e3,
                     there.at("Displacement_Y") * 1e3);
}

std::int64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024L;
}

}  // namespace

Summary summarise(StagedRun& run, const RunOutcome& outcome, double wall_seconds) {
  Simulation& s = run.simulation();
  Summary summary;
  summary.status = outcome.status;
  summary.message = outcome.message;
  summary.title = s.scene().title;
  summary.formulation = motion_name(s.scene().formulation.motion);
  summary.kernel_correction = s.scene().formulation.kernel_correction;
  summary.particles = static_cast<std::int64_t>(s.model().particles.size());
  summary.steps = run.steps();
  summary.stages = run.ended();
  summary.time = s.time();
  summary.time_step = s.time_step();
  std::int64_t particle_steps = run.particle_steps();
  if (const Consolidation* c = s.consolidation()) {
    const auto& counts = c->counts();
    summary.steps = counts.flow_steps, particle_steps = summary.particles * counts.soil_sweeps;
    summary.time_step = s.time() / static_cast<double>(std::max<std::int64_t>(1, counts.flow_steps));
    summary.consolidation = {counts.flow_steps,  counts.pressure_solves, counts.krylov_iterations,
                             counts.soil_sweeps, c->drained(),           c->imbalance()};
  }
  if (s.seepage() != nullptr) {
    summary.transient = transient_summary(s);
    summary.steps = summary.transient->flow_steps;
    particle_steps = summary.particles * summary.transient->soil_sweeps;
    summary.time_step = s.time() / static_cast<double>(std::max<std::int64_t>(1, summary.steps));
  }
  if (s.in_motion()) summary.motion = motion_summary(s);
  if (s.follows_flow()) summary.steps += s.moves(), particle_steps += summary.particles * s.moves();
  summary.courant = s.courant();
  summary.scaled_inertia = scaled_inertia(s.scene());
  summary.threads = omp_get_max_threads();
  summary.wall_seconds = wall_seconds;
  summary.stepping_seconds = outcome.stepping_seconds;
  summary.particle_steps_per_second = static_cast<double>(particle_steps) / outcome.stepping_seconds;
  summary.peak_memory_bytes = peak_memory();
  const bool balances = s.showable() && !s.scene().water.transient.rigid;
  summary.unbalanced_force_ratio =
      balances ? s.unbalanced_force_ratio() : std::numeric_limits<double>::quiet_NaN();
  summary.energy_growth = outcome.energy_growth;
  summary.energy = outcome.energy;
  if (s.showable()) {
    const Zigzag zigzag = measure_zigzag(s.model());
    summary.zigzag = {.rms = zigzag.rms,
                      .quantile = zigzag.quantile,
                      .largest = zigzag.largest,
                      .x = zigzag.where.x(),
                      .y = zigzag.where.y()};
  }
  if (const FlowRecord* flow = s.model().pore_water->record()) {
    summary.seepage = {flow->through_faces, flow->imbalance, flow->newton_steps, flow->krylov_iterations};
    for (std::size_t i = 0; i < flow->through_sections.size(); ++i)
      summary.seepage->sections[s.scene().sections[i].name] = flow->through_sections[i];
  }
  summary.probes = probe_readings(s);
  if (s.showable()) summary.footings = footing_readings(s), summary.sheets = sheet_readings(s);
  if (s.showable()) summary.errors = reference_errors(s);
  summary.skipped = skipped_work(s);
  return summary;
}

std::string tell(const Summary& s) {
  static constexpr const char* endings[] = {"completed", "in equilibrium", "unstable", "interrupted"};
  const bool well = s.status == RunStatus::completed || s.status == RunStatus::equilibrium;
  std::string text =
      fmt::format("{} at {:.6g} s, {} steps of {:.3g} s",
                  styled(stdout, well ? Style::good : Style::error, endings[static_cast<int>(s.status)]),
                  s.time, s.steps, s.time_step);
  if (!s.message.empty()) text += ": " + s.message;
  text += fmt::format("\n{} particles, {} formulation, {:.2f} s of stepping", s.particles, s.formulation,
                      s.stepping_seconds);
  if (s.particle_steps_per_second > 0)  // of a flow in soil that keeps still there are none
    text += fmt::format(", {:.2f} M particle-steps/s", s.particle_steps_per_second / 1e6);
  text += "\n";
  if (!s.scaled_inertia.empty()) text += "inertia " + inertia_text(s.scaled_inertia) + "\n";
  if (!std::isfinite(s.energy_growth)) return text;  // broken down: there is no state to tell of
  if (std::isfinite(s.unbalanced_force_ratio))
    text += fmt::format("unbalanced force ratio {:.2e}\n", s.unbalanced_force_ratio);
  if (s.zigzag && s.zigzag->rms > 0)
    text += fmt::format(
        "zigzag of displacements {:.2g} of the difference of neighbours, at most {:.3g} mm at {}\n",
        s.zigzag->rms, 1e3 * s.zigzag->largest, place_text({s.zigzag->x, s.zigzag->y}));
  if (s.energy && s.energy->released > 0) text += tell(*s.energy);
  if (s.seepage) text += tell(*s.seepage);
  if (s.consolidation) text += tell(*s.consolidation);
  if (s.transient) text += tell(*s.transient);
  if (s.motion) text += tell(*s.motion);
  text += tell(s.stages);
  for (const auto& [name, probe] : s.probes)
    if (std::isnan(probe.values.at("Displacement_Y")))
      text += fmt::format("{} {}: in soil that is not there\n", name, place_text({probe.x, probe.y}));
    else
      text += fmt::format("{} {}: sigma'_yy = {:.3f} kPa, u_y = {:.3f} mm{}\n", name,
                          place_text({probe.x, probe.y}), probe.values.at("EffectiveStress_YY") / 1e3,
                          probe.values.at("Displacement_Y") * 1e3, beside_finite_elements(s, name));
  for (const auto& [name, f] : s.footings)
    text += fmt::format("{}: {:.5g} kN/m, {:.3g} kN/m along it, settled {:.4g} mm\n", name, f.force / 1e3,
                        f.shear / 1e3, 1e3 * f.settlement);
  for (const auto& [name, sheet] : s.sheets)
    text +=
        fmt::format("{}: at most {:.4g} kNm/m, {:.4g} kN/m of shear, {:.4g} kN/m along it; moved {:.4g} mm\n",
                    name, sheet.moment / 1e3, sheet.shear / 1e3, sheet.axial / 1e3, 1e3 * sheet.displacement);
  for (const auto& [field, error] : s.errors) {
    const bool stress = field.starts_with("EffectiveStress");
    text +=
        fmt::format("{} against the exact solution: {:.3f} % (L2), at most {:.3f} {}\n", field,
                    100 * error.relative_l2, error.max_abs / (stress ? 1e3 : 1e-3), stress ? "kPa" : "mm");
  }
  if (s.finite_elements) text += tell(*s.finite_elements);
  return text;
}

std::map<std::string, double> scaled_inertia(const Case& scene) {
  const std::vector<double> inertia = inertia_over_mass(scene);
  std::map<std::string, double> scaled;
  for (std::size_t i = 0; i < inertia.size(); ++i)
    if (inertia[i] > 1) scaled[scene.soils[i].name] = inertia[i];
  return scaled;
}

std::string inertia_text(const std::map<std::string, double>& scaled) {
  std::vector<std::string> parts;
  for (const auto& [soil, inertia] : scaled)
    parts.push_back(fmt::format("{:.3g} times in '{}'", inertia, soil));
  return fmt::format("on the way to rest that of the mass {}: time does not count", fmt::join(parts, ", "));
}

}  // namespace porosph::app
