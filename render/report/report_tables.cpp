#include "render/report/report_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "render/report/comparison.hpp"
#include "render/report/html.hpp"
#include "render/report/settings.hpp"
#include "render/run/history_lines.hpp"
#include "render/run/shown_field.hpp"
#include "solver/case/case_file.hpp"
#include "solver/space/place_text.hpp"

namespace porosph::render {
namespace {

std::string status_text(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return "completed";
    case RunStatus::equilibrium:
      return "in equilibrium";
    case RunStatus::unstable:
      return "unstable";
    case RunStatus::interrupted:
      return "interrupted";
  }
  throw std::logic_error("unknown status");
}

/// The field that summary.json calls "EffectiveStress_YY".
FieldSelection selection_of(const std::string& text) {
  const auto at = text.find('_');
  return {text.substr(0, at), at == std::string::npos ? "" : text.substr(at + 1)};
}

/// "head 4.5 m, (0, 0) to (17, 6) m".
std::string face_text(const HydraulicFaceCase& face) {
  const char* kind = face.kind == FaceKind::head      ? "head"
                     : face.kind == FaceKind::seepage ? "seepage"
                     : face.kind == FaceKind::flux    ? "flux"
                                                      : "closed";
  const std::string level = face.kind == FaceKind::head ? fmt::format(" {:g} m", face.level) : "";
  const std::string place = face.everywhere()
                                ? "the whole outline"
                                : fmt::format("{} to {} m", place_text(face.from), place_text(face.to));
  return fmt::format("{}{}, {}", kind, level, place);
}

}  // namespace

std::string number(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "–";
}

Rows run_table(const std::vector<LoadedRun>& runs) {
  Rows rows = {{"Run"},
               {"Outcome"},
               {"Formulation"},
               {"Kernel correction"},
               {"Damping ξ"},
               {"Particles"},
               {"Time steps"},
               {"Time step [s]"},
               {"End [s]"},
               {"Unbalanced force ratio"},
               {"Run time [s]"},
               {"Threads"},
               {"Particle-steps per second"}};
  for (const LoadedRun& r : runs) {
    const Summary& s = *r.run.summary;
    const std::vector<std::string> column = {r.label,
                                             status_text(s.status),
                                             s.formulation,
                                             s.kernel_correction ? "on" : "off",
                                             r.run.scene->loading.adaptive_damping
                                                 ? "adaptive"
                                                 : fmt::format("{:g}", r.run.scene->loading.damping),
                                             fmt::format("{}", s.particles),
                                             fmt::format("{}", s.steps),
                                             fmt::format("{:.3g}", s.time_step),
                                             fmt::format("{:.4g}", s.time),
                                             number(s.unbalanced_force_ratio, "{:.2e}"),
                                             fmt::format("{:.1f}", s.wall_seconds),
                                             fmt::format("{}", s.threads),
                                             number(s.particle_steps_per_second / 1e6, "{:.2f} M")};
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(column[i]);
  }
  return rows;
}

Rows energy_table(const std::vector<LoadedRun>& runs) {
  Rows rows = {{"Energy"}};
  const auto add = [&](const char* name, auto&& part) {
    std::vector<std::string> row = {name};
    for (const LoadedRun& r : runs) {
      const auto& energy = r.run.summary->energy;
      row.push_back(energy ? part(*energy) : "–");
    }
    rows.push_back(std::move(row));
  };
  if (std::ranges::none_of(runs, [](const LoadedRun& r) { return r.run.summary->energy.has_value(); }))
    return rows;
  for (const LoadedRun& r : runs) rows[0].push_back(r.label);
  using Budget = Summary::EnergyBudget;
  add("released [J/m]", [](const Budget& e) { return number(e.released, "{:.4g}"); });
  const auto share = [&](const char* name, double Budget::*part) {
    add(name, [part](const Budget& e) { return number(100 * e.*part / e.released, "{:.2f} %"); });
  };
  share("kinetic now", &Budget::kinetic), share("elastic gained", &Budget::elastic);
  share("dissipated by the soil", &Budget::plastic), share("by the zero-energy control", &Budget::control);
  share("by walls that stop loose particles", &Budget::contact);
  share("by friction on walls", &Budget::friction);
  share("by the stress behind walls", &Budget::walls);
  share("by the diffusion of stress", &Budget::diffusion);
  share("by bulk viscosity", &Budget::bulk_viscosity);
  if (std::ranges::any_of(runs, [](const LoadedRun& r) {
        return r.run.summary->energy && r.run.summary->energy->water != 0;
      }))
    share("by the pore water", &Budget::water);
  share("unaccounted for", &Budget::unaccounted);
  return rows;
}

Rows water_table(const std::vector<LoadedRun>& runs) {
  Rows rows = {{"Water [m2/s]"}};
  const auto flowing = std::ranges::find_if(
      runs, [](const LoadedRun& r) { return r.run.summary->seepage.has_value() && r.run.scene; });
  if (flowing == runs.end()) return rows;
  for (const LoadedRun& r : runs) rows[0].push_back(r.label);
  const auto add = [&](std::string name, auto&& part) {
    rows.push_back({std::move(name)});
    for (const LoadedRun& r : runs)
      rows.back().push_back(r.run.summary->seepage ? part(*r.run.summary->seepage) : "–");
  };
  const auto& faces = flowing->run.scene->water.faces;
  const auto& through = flowing->run.summary->seepage->through_faces;
  for (std::size_t i = 0; i < std::min(faces.size(), through.size()); ++i)
    if (faces[i].kind != FaceKind::closed)
      add(face_text(faces[i]), [&](const auto& seepage) {
        return seepage.through_faces.size() == faces.size() ? number(seepage.through_faces[i], "{:.3g}")
                                                            : "–";
      });
  const auto sum = [](const std::vector<double>& flows, double sign) {
    double total = 0;
    for (const double flow : flows) total += std::max(sign * flow, 0.);
    return number(total, "{:.3g}");
  };
  add("enters", [&](const auto& seepage) { return sum(seepage.through_faces, 1); });
  add("leaves", [&](const auto& seepage) { return sum(seepage.through_faces, -1); });
  add("difference over what enters",
      [](const auto& seepage) { return number(100 * seepage.imbalance, "{:.2g} %"); });
  return rows;
}

Rows error_table(const std::vector<LoadedRun>& runs) {
  Rows rows = {{"Field"}};
  std::map<std::string, std::size_t> row_of;
  for (const LoadedRun& r : runs)
    for (const auto& [field, norms] : r.run.summary->errors)
      if (row_of.try_emplace(field, rows.size()).second) rows.push_back({shown_name(selection_of(field))});
  for (const LoadedRun& r : runs) {
    rows[0].push_back(r.label);
    for (const auto& [field, row] : row_of) {
      const auto found = r.run.summary->errors.find(field);
      if (found == r.run.summary->errors.end()) {
        rows[row].push_back("–");
        continue;
      }
      const ShownUnit unit = shown_unit(selection_of(field).name, found->second.max_abs);
      rows[row].push_back(number(100 * found->second.relative_l2, "{:.3g} %") +
                          number(found->second.max_abs * unit.factor, " (at most {:.3g} ") + unit.name + ")");
    }
  }
  return rows;
}

Rows fem_table(const std::vector<LoadedRun>& runs, const std::vector<std::vector<FieldNorms>>& norms) {
  Rows rows = {{"Field"}};
  for (const FieldNorms& n : norms.front()) rows.push_back({shown_name(n.field)});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    rows[0].push_back(runs[i].label);
    for (std::size_t row = 1; row < rows.size(); ++row) {
      const auto found = std::find_if(norms[i].begin(), norms[i].end(), [&](const FieldNorms& n) {
        return shown_name(n.field) == rows[row][0];
      });
      rows[row].push_back(found == norms[i].end() ? "–"
                                                  : relative_text(found->relative_l2) + " (at most " +
                                                        largest_text(*found) + ")");
    }
  }
  return rows;
}

Rows probe_table(const std::vector<LoadedRun>& runs, const std::optional<FemReference>& fem) {
  const Case& scene = *runs.front().run.scene;
  Rows rows = {{"Probe"}};
  for (const LoadedRun& r : runs) rows[0].push_back(r.label);
  const bool theory = scene.reference == Reference::column;
  if (theory) rows[0].push_back("Theory");
  if (fem) rows[0].push_back("Finite elements");
  for (const ProbeCase& probe : scene.probes)
    for (const FieldSelection& field :
         {FieldSelection{"EffectiveStress", "XX"}, FieldSelection{"EffectiveStress", "YY"},
          FieldSelection{"EffectiveStress", "ZZ"}, FieldSelection{"EffectiveStress", "XY"},
          FieldSelection{"Displacement", "Y"}}) {
      const ShownUnit unit = shown_unit(field.name, 0);
      std::vector<std::string>& row = rows.emplace_back();
      row.push_back(probe.name + ": " + shown_label(field, unit));
      const auto put = [&](std::optional<double> value) {
        const double shown = value.value_or(0) * unit.factor;
        row.push_back(!value ? "–" : std::abs(shown) < 5e-4 ? "0.000" : number(shown, "{:.3f}"));
      };
      for (const LoadedRun& r : runs) {
        const auto& probes = r.run.summary->probes;
        const auto found = probes.find(probe.name);
        put(found != probes.end() && found->second.values.contains(field.text())
                ? std::optional(found->second.values.at(field.text()))
                : std::nullopt);
      }
      if (theory) put(theory_at(scene, probe, field.text()));
      if (fem) put(fem->values(field, {probe.position})[0]);
    }
  return rows;
}

Rows settings_table(const std::vector<LoadedRun>& runs) {
  std::vector<Case> scenes;
  Rows rows = {{"Setting"}};
  for (const LoadedRun& r : runs) rows[0].push_back(r.label), scenes.push_back(*r.run.scene);
  for (const DifferingSetting& d : differing_settings(scenes)) {
    rows.push_back({d.key});
    for (const std::string& v : d.values) rows.back().push_back(v.empty() ? "–" : v);
  }
  return rows;
}

std::string markdown(const Rows& rows) {
  const auto line = [](const std::vector<std::string>& cells) {
    std::string text = "|";
    for (std::string cell : cells) {
      for (std::size_t at = 0; (at = cell.find('|', at)) != std::string::npos; at += 2)
        cell.replace(at, 1, "\\|");
      text += " " + html::escaped(cell) + " |";
    }
    return text + "\n";
  };
  std::string text = line(rows.front()) + "|";
  for (std::size_t i = 0; i < rows.front().size(); ++i) text += " --- |";
  text += "\n";
  for (std::size_t i = 1; i < rows.size(); ++i) text += line(rows[i]);
  return text + "\n";
}

}  // namespace porosph::render
