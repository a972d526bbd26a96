#include "render/report/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "render/report/comparison.hpp"
#include "render/report/fem_check_section.hpp"
#include "render/report/html.hpp"
#include "render/report/report_pictures.hpp"
#include "render/report/settings.hpp"
#include "render/report/stages_section.hpp"
#include "render/report/study.hpp"
#include "render/run/history_lines.hpp"
#include "render/run/run_panel.hpp"
#include "solver/case/case_file.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

constexpr double tolerable_energy_growth = 0.01;  ///< of the energy at work
constexpr double usual_rest = 1e-3;  ///< unbalanced force ratio under which a state counts as at rest

void require_reportable(const std::vector<FinishedRun>& runs) {
  for (const FinishedRun& run : runs) {
    if (!run.scene)
      throw std::runtime_error(run.folder.string() + " holds no case.toml: it cannot be reported");
    if (!run.summary)
      throw std::runtime_error(run.folder.string() + " holds no summary.json: it cannot be reported");
    if (const std::string reason = obstacle(run, runs.front()); !reason.empty())
      throw std::runtime_error(fmt::format("{} and {} do not fit into one report: {}",
                                           runs.front().folder.string(), run.folder.string(), reason));
  }
}

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

std::string number(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "–";
}

std::vector<std::string> warnings_of(const LoadedRun& r) {
  const Summary& s = *r.run.summary;
  std::vector<std::string> warnings;
  if (s.status == RunStatus::unstable) warnings.push_back(r.label + " became unstable: " + s.message);
  if (s.status == RunStatus::interrupted)
    warnings.push_back(
        fmt::format("{} was interrupted at {:g} s; its pictures show that instant", r.label, s.time));
  if (s.status != RunStatus::unstable && !(s.unbalanced_force_ratio < usual_rest) &&
      r.run.scene->loading.gravity_applied)
    warnings.push_back(fmt::format(
        "{} is not in equilibrium: its unbalanced forces are {} of the weights (at rest: below {:g})",
        r.label, number(s.unbalanced_force_ratio, "{:.2g}"), usual_rest));
  if (s.energy_growth > tolerable_energy_growth)
    warnings.push_back(
        fmt::format("{} gained energy, {} of what moves and strains at its end: its motion equation does "
                    "not conserve it, and without damping it may become unstable",
                    r.label, number(100 * s.energy_growth, "{:.2g} %")));
  if (s.finite_elements)
    for (const std::string& text : s.finite_elements->warnings) warnings.push_back(r.label + ": " + text);
  return warnings;
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

/// The field that summary.json calls "EffectiveStress_YY".
FieldSelection selection_of(const std::string& text) {
  const auto at = text.find('_');
  return {text.substr(0, at), at == std::string::npos ? "" : text.substr(at + 1)};
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

bool all_have(const std::vector<LoadedRun>& runs, const FieldSelection& field) {
  return std::all_of(runs.begin(), runs.end(),
                     [&](const LoadedRun& r) { return can_show(r.last, field.name); });
}

std::string pictures_of(const std::vector<ReportPicture>& pictures) {
  std::string text;
  for (const ReportPicture& p : pictures) text += html::figure(p.file, p.description, p.caption);
  return text;
}

std::string list(const std::vector<std::string>& items) {
  std::string text = "<ul>\n";
  for (const std::string& item : items) text += "<li>" + html::escaped(item) + "</li>\n";
  return text + "</ul>\n";
}

/// The summary of a run as other programs see it, with its norms against finite elements.
Json summary_json(const LoadedRun& r, const std::vector<FieldNorms>& fem) {
  Json json = Json::parse(read_file(r.run.folder / "summary.json"));
  for (const FieldNorms& n : fem)
    json["fem"][n.field.text()] = {
        {"relative_l2", std::isfinite(n.relative_l2) ? Json(n.relative_l2) : Json(nullptr)},
        {"max_abs", std::isfinite(n.max_abs) ? Json(n.max_abs) : Json(nullptr)}};
  return json;
}

struct Checked {
  std::vector<std::string> failed;
  Rows rows = {{"Fails if", "Run", "Value", "Outcome"}};
  Json json = Json::array();
};

Checked check_all(const std::vector<Threshold>& thresholds, const std::vector<LoadedRun>& runs,
                  const std::vector<Json>& summaries) {
  Checked checked;
  for (const Threshold& t : thresholds)
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const ThresholdOutcome outcome = check(t, summaries[i]);
      const std::string value =
          std::isfinite(outcome.value) ? fmt::format("{:.6g}", outcome.value) : "not a number";
      if (outcome.failed)
        checked.failed.push_back(fmt::format("{}: {} (it is {})", runs[i].label, t.text, value));
      checked.rows.push_back({t.text, runs[i].label, value, outcome.failed ? "failed" : "kept"});
      checked.json.push_back({{"fail_if", t.text},
                              {"run", runs[i].label},
                              {"value", std::isfinite(outcome.value) ? Json(outcome.value) : Json(nullptr)},
                              {"failed", outcome.failed}});
    }
  return checked;
}

std::string how_to_reproduce(const ReportInput& input, const std::vector<LoadedRun>& runs) {
  std::string commands;
  for (const LoadedRun& r : runs)
    commands += fmt::format("porosph run {0}/case.toml --out {0}\n", r.run.folder.string());
  std::string text =
      "<p>Each run's folder holds its complete case, which gives the same result again:</p>\n<pre>" +
      html::escaped(commands + input.command) + "</pre>\n";
  for (const LoadedRun& r : runs)
    text += "<details><summary>The case of " + html::escaped(r.label) + "</summary><pre>" +
            html::escaped(write_case(*r.run.scene)) + "</pre></details>\n";
  return text;
}

void write_page(const std::string& page, bool single_file, const fs::path& folder) {
  write_file(folder / "index.html", single_file ? html::with_pictures(page, folder) : page);
  if (!single_file) return;
  for (const std::string& file : html::pictures_of(page)) {
    std::error_code none;
    fs::remove(folder / file, none);
  }
}

/// A table as GitHub and GitLab show it.
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

std::string markdown_summary(const ReportInput& input, const std::vector<LoadedRun>& runs,
                             const std::vector<std::vector<FieldNorms>>& fem, const Checked& checked,
                             const std::vector<std::string>& warnings) {
  std::string text = "## " + html::escaped(runs.front().run.scene->title) + "\n\n";
  for (const std::string& w : warnings) text += "- **" + html::escaped(w) + "**\n";
  if (!warnings.empty()) text += "\n";
  text += markdown(run_table(runs));
  if (!input.thresholds.empty()) text += "### Thresholds\n\n" + markdown(checked.rows);
  if (const Rows rows = error_table(runs); rows.size() > 1)
    text += "### Errors against the exact solution\n\n" + markdown(rows);
  if (input.fem) text += "### Differences from finite elements\n\n" + markdown(fem_table(runs, fem));
  return text + html::escaped(input.made) + "\n";
}

}  // namespace

std::vector<std::string> write_report(const ReportInput& input, const fs::path& folder) {
  require_reportable(input.runs);
  for (const fs::path& study : input.studies) read_study(study);  // before anything is drawn
  if (input.fem)
    for (const FinishedRun& run : input.runs) require_same_problem(run, *input.fem);
  const std::vector<std::string> labels = run_labels(input.runs);
  std::vector<LoadedRun> runs;
  for (std::size_t i = 0; i < input.runs.size(); ++i)
    runs.push_back(
        {input.runs[i], labels[i], frame_of(input.runs[i], input.runs[i].series.frames.size() - 1)});
  std::vector<std::vector<FieldNorms>> fem(runs.size());
  std::vector<Json> summaries;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (input.fem) fem[i] = fem_norms(runs[i].last, *input.fem, input.left_out);
    summaries.push_back(summary_json(runs[i], fem[i]));
  }
  const Checked checked = check_all(input.thresholds, runs, summaries);
  make_folder(folder);

  const Case& scene = *runs.front().run.scene;
  const std::string head =
      "<h1>" + html::escaped(scene.title) + "</h1>\n<p class=\"lead\">" +
      html::escaped(fmt::format("{} of {} particles: {}", runs.size() == 1 ? "A run" : "Runs",
                                runs.front().run.summary->particles, fmt::join(labels, ", "))) +
      "</p>\n" + (input.made.empty() ? "" : html::paragraph(input.made));
  std::string body;
  std::vector<std::string> warnings = checked.failed;
  for (std::string& w : warnings) w = "Threshold failed: " + w;
  for (const LoadedRun& r : runs)
    for (std::string& w : warnings_of(r)) warnings.push_back(std::move(w));
  const std::string notes =
      warnings.empty() ? "" : "<div class=\"warnings\" role=\"note\">" + list(warnings) + "</div>\n";
  body += html::section("Runs", html::table(run_table(runs)));
  std::vector<Summary> told;
  for (const LoadedRun& r : runs) told.push_back(*r.run.summary);
  body += stages_section(labels, told);
  body += html::section("The case", pictures_of({draw_case(runs.front(), folder)}));

  std::vector<ReportPicture> contours;
  for (const FieldSelection& field :
       {FieldSelection{"TotalStress", "YY"}, FieldSelection{"EffectiveStress", "YY"},
        FieldSelection{"Displacement", "Y"}})
    if (all_have(runs, field)) contours.push_back(draw_contours(runs, input.fem, field, folder));
  if (all_have(runs, {"EffectiveStress", "YY"}))
    if (auto picture = draw_differences(runs, input.fem, input.left_out, {"EffectiveStress", "YY"}, folder))
      contours.push_back(std::move(*picture));
  body += html::section("Stress and displacement", pictures_of(contours));
  if (all_have(runs, {"EffectiveStress", "YY"}))
    if (auto picture = draw_sections(runs, input.fem, folder))
      body += html::section("Stress with height", pictures_of({std::move(*picture)}) +
                                                      "<p><a href=\"sections.csv\">sections.csv</a></p>\n");

  std::vector<ReportPicture> histories;
  if (auto picture = draw_histories(input.runs, labels, folder)) histories.push_back(std::move(*picture));
  if (input.fem)
    for (const ProbeCase& probe : scene.probes)
      if (auto picture = draw_probe(runs, *input.fem, probe, folder))
        histories.push_back(std::move(*picture));
  if (!scene.probes.empty())
    body += html::section("Probes", pictures_of(histories) + html::table(probe_table(runs, input.fem)));

  if (const Rows rows = error_table(runs); rows.size() > 1)
    body += html::section(
        "Errors against the exact solution",
        "<p>Relative L2 norm over all particles, and the largest difference.</p>\n" + html::table(rows));
  body += fem_check_section(labels, told);
  if (input.fem) {
    std::string text = "<p>Relative L2 norm over the particles, and the largest difference.";
    for (const LeftOut& o : input.left_out)
      text += html::escaped(
          fmt::format(" Left out: {:g} m around ({:g}, {:g}) m.", o.radius, o.at.x(), o.at.y()));
    body += html::section("Differences from finite elements",
                          text + "</p>\n" + html::table(fem_table(runs, fem)));
  }
  if (!input.thresholds.empty()) body += html::section("Thresholds", html::table(checked.rows, false));

  std::vector<ReportPicture> developments;
  for (const LoadedRun& r : runs)
    if (all_have({r}, {"EffectiveStress", "YY"}) && r.run.series.frames.size() > 2)
      developments.push_back(draw_development(r, {"EffectiveStress", "YY"}, folder));
  if (!developments.empty()) body += html::section("How the stress develops", pictures_of(developments));

  if (const Rows rows = settings_table(runs); rows.size() > 1)
    body += html::section("Settings that differ", html::table(rows, false));
  for (std::size_t i = 0; i < input.studies.size(); ++i)
    body += study_section(input.studies[i], folder, fmt::format("study_{}_", i + 1));
  body += html::section("How to reproduce", how_to_reproduce(input, runs));
  write_page(html::page(scene.title, head + notes + html::contents(body) + body), input.single_file, folder);

  Json json = {{"runs", Json::object()}, {"thresholds", checked.json}, {"warnings", warnings}};
  for (std::size_t i = 0; i < runs.size(); ++i) json["runs"][runs[i].label] = summaries[i];
  for (const fs::path& study : input.studies) json["studies"].push_back(to_json(read_study(study)));
  write_file(folder / "report.json", json.dump(2) + "\n");
  if (!input.summary.empty())
    write_file(input.summary, markdown_summary(input, runs, fem, checked, warnings));
  return checked.failed;
}

}  // namespace porosph
