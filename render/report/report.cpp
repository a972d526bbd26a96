#include "render/report/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "render/report/comparison.hpp"
#include "render/report/fem_check_section.hpp"
#include "render/report/html.hpp"
#include "render/report/report_pictures.hpp"
#include "render/report/report_tables.hpp"
#include "render/report/stages_section.hpp"
#include "render/report/study.hpp"
#include "render/run/run_panel.hpp"
#include "solver/case/case_file.hpp"
#include "solver/space/place_text.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::render {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

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

/// Flowing water, footings, sheets and loads that change do work on the soil: energy that it gains there is
/// no error.
bool energy_is_its_own(const Case& c) {
  const bool loads_change =
      std::ranges::any_of(c.loads, [](const LoadCase& load) { return !load.over_time.empty(); });
  return !loads_change && !c.water.flows() && c.water.level_over_time.empty() && c.footings.empty() &&
         c.sheets.empty() && c.stages.empty();
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
  if (s.energy_growth > tolerable_energy_growth && energy_is_its_own(*r.run.scene))
    warnings.push_back(
        fmt::format("{} gained energy, {} of what moves and strains at its end: its motion equation does "
                    "not conserve it, and without damping it may become unstable",
                    r.label, number(100 * s.energy_growth, "{:.2g} %")));
  if (s.finite_elements)
    for (const std::string& text : s.finite_elements->warnings) warnings.push_back(r.label + ": " + text);
  return warnings;
}

bool all_have(const std::vector<LoadedRun>& runs, const FieldSelection& field) {
  return std::all_of(runs.begin(), runs.end(),
                     [&](const LoadedRun& r) { return can_show(r.last, field.name); });
}

std::string pictures_of(const std::vector<ReportPicture>& pictures) {
  std::string text;
  for (const ReportPicture& p : pictures) text += html::figure(p.file, p.description, p.caption, p.panels);
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

std::string markdown_summary(const ReportInput& input, const std::vector<LoadedRun>& runs,
                             const std::vector<std::vector<FieldNorms>>& fem, const Checked& checked,
                             const std::vector<std::string>& warnings) {
  std::string text = "## " + html::escaped(runs.front().run.scene->title) + "\n\n";
  for (const std::string& w : warnings) text += "- **" + html::escaped(w) + "**\n";
  if (!warnings.empty()) text += "\n";
  text += markdown(run_table(runs));
  if (const Rows rows = energy_table(runs); rows.size() > 1) text += "### Energy\n\n" + markdown(rows);
  if (!input.thresholds.empty()) text += "### Thresholds\n\n" + markdown(checked.rows);
  if (const Rows rows = error_table(runs); rows.size() > 1)
    text += "### Errors against the exact solution\n\n" + markdown(rows);
  if (input.fem) text += "### Differences from finite elements\n\n" + markdown(fem_table(runs, fem));
  return text + html::escaped(input.made) + "\n";
}

/// What is drawn: as asked for, else what all runs have of the usual ones, the vertical effective stress
/// first.
std::vector<ReportField> fields_of(const ReportInput& input, const std::vector<LoadedRun>& runs) {
  if (!input.fields.empty()) {
    for (const ReportField& shown : input.fields)
      for (const LoadedRun& r : runs) values_of(r.last, shown.field);  // says what is missing
    return input.fields;
  }
  std::vector<ReportField> fields;
  for (const FieldSelection& field :
       {FieldSelection{"EffectiveStress", "YY"}, FieldSelection{"TotalStress", "YY"},
        FieldSelection{"Displacement", "Y"}})
    if (all_have(runs, field)) fields.push_back({field, {}});
  return fields;
}

/// Each field of all runs, what differs in the first (in all that were asked for), and a slider for two runs.
std::string fields_part(const std::vector<LoadedRun>& runs, const ReportInput& input,
                        const std::vector<ReportField>& fields, const fs::path& folder) {
  std::string text;
  for (const ReportField& shown : fields) {
    text += pictures_of({draw_contours(runs, input.fem, shown, folder)});
    if (&shown != &fields.front() && input.fields.empty()) continue;
    if (auto picture = draw_differences(runs, input.fem, input.left_out, shown.field, folder))
      text += pictures_of({std::move(*picture)});
  }
  if (runs.size() != 2 || fields.empty()) return text;
  const std::vector<html::Instant> pair = draw_pair(runs[0], runs[1], fields.front(), folder);
  return text + "<h3>One against the other</h3>\n" + html::slider(pair[0], pair[1]);
}

/// Six instants, and a player, of each run that has frames between its ends; narrow windows have the player
/// alone.
std::string development_part(const std::vector<LoadedRun>& runs, const ReportField& shown,
                             const ReportInput& input, const fs::path& folder) {
  const bool plays = input.instants > 1;
  std::string text;
  for (const LoadedRun& r : runs) {
    if (r.run.series.frames.size() < 3) continue;
    const std::string six = pictures_of({draw_development(r, shown, !plays, folder)});
    text += plays ? "<div class=\"wide\">\n" + six + "</div>\n" : six;
    if (plays)
      text += html::player(draw_instants(r, shown, input.instants, folder),
                           shown_name(shown.field) + " in run " + r.label);
  }
  return text;
}

/// All that the page is made of.
struct Material {
  const ReportInput& input;
  const fs::path& folder;
  std::vector<std::string> labels;
  std::vector<LoadedRun> runs;
  std::vector<std::vector<FieldNorms>> fem;
  std::vector<Json> summaries;
  Checked checked;
  std::vector<std::string> warnings;
  std::vector<ReportField> fields;  ///< that are drawn

  const Case& scene() const { return *runs.front().run.scene; }
};

Material load(const ReportInput& input, const fs::path& folder) {
  Material m{input, folder, run_labels(input.runs), {}, {}, {}, {}, {}, {}};
  for (std::size_t i = 0; i < input.runs.size(); ++i) {
    const std::size_t last = input.runs[i].series.frames.size() - 1;
    m.runs.push_back({input.runs[i], m.labels[i], frame_of(input.runs[i], last)});
  }
  m.fem.resize(m.runs.size());
  for (std::size_t i = 0; i < m.runs.size(); ++i) {
    if (input.fem) m.fem[i] = fem_norms(m.runs[i].last, *input.fem, input.left_out);
    m.summaries.push_back(summary_json(m.runs[i], m.fem[i]));
  }
  m.checked = check_all(input.thresholds, m.runs, m.summaries);
  for (const std::string& w : m.checked.failed) m.warnings.push_back("Threshold failed: " + w);
  for (const LoadedRun& r : m.runs)
    for (std::string& w : warnings_of(r)) m.warnings.push_back(std::move(w));
  m.fields = fields_of(input, m.runs);
  return m;
}

std::vector<Summary> summaries_of(const Material& m) {
  std::vector<Summary> told;
  for (const LoadedRun& r : m.runs) told.push_back(*r.run.summary);
  return told;
}

std::string head_of(const Material& m) {
  return "<h1>" + html::escaped(m.scene().title) + "</h1>\n<p class=\"lead\">" +
         html::escaped(fmt::format("{} of {} particles: {}", m.runs.size() == 1 ? "A run" : "Runs",
                                   m.runs.front().run.summary->particles, fmt::join(m.labels, ", "))) +
         "</p>\n" + (m.input.made.empty() ? "" : html::paragraph(m.input.made));
}

std::string stress_sections(const Material& m) {
  const std::string shown = fields_part(m.runs, m.input, m.fields, m.folder);
  std::string body = html::section(m.input.fields.empty() ? "Stress and displacement" : "Fields", shown);
  if (m.fields.empty()) return body;
  if (auto picture = draw_sections(m.runs, m.input.fem, m.input.sections, m.fields.front().field, m.folder))
    body += html::section("Sections", pictures_of({std::move(*picture)}) +
                                          "<p><a href=\"sections.csv\">sections.csv</a></p>\n");
  return body;
}

std::string probe_section(const Material& m) {
  std::vector<ReportPicture> histories;
  if (auto picture = draw_histories(m.input.runs, m.labels, m.folder))
    histories.push_back(std::move(*picture));
  for (const auto& draw : {draw_settlement, draw_stress_paths})
    if (auto picture = draw(m.input.runs, m.labels, m.folder)) histories.push_back(std::move(*picture));
  if (m.input.fem)
    for (const ProbeCase& probe : m.scene().probes)
      if (auto picture = draw_probe(m.runs, *m.input.fem, probe, m.folder))
        histories.push_back(std::move(*picture));
  if (m.scene().probes.empty()) return "";
  return html::section("Probes", pictures_of(histories) + html::table(probe_table(m.runs, m.input.fem)));
}

std::string water_section(const Material& m) {
  auto picture = draw_water(m.input.runs, m.labels, m.folder);
  return picture ? html::section("Water", pictures_of({std::move(*picture)})) : "";
}

std::string difference_sections(const Material& m) {
  std::string body;
  if (const Rows rows = water_table(m.runs); rows.size() > 1)
    body += html::section("Water balance",
                          "<p>What flows into the soil, per metre of its length; negative: out of it.</p>\n" +
                              html::table(rows));
  if (const Rows rows = energy_table(m.runs); rows.size() > 1)
    body +=
        html::section("Energy", "<p>Where the energy went that gravity released.</p>\n" + html::table(rows));
  if (const Rows rows = error_table(m.runs); rows.size() > 1)
    body += html::section(
        "Errors against the exact solution",
        "<p>Relative L2 norm over all particles, and the largest difference.</p>\n" + html::table(rows));
  std::vector<Summary> told;
  for (const LoadedRun& r : m.runs) told.push_back(*r.run.summary);
  body += fem_check_section(m.labels, told);
  if (m.input.fem) {
    std::string text = "<p>Relative L2 norm over the particles, and the largest difference.";
    for (const LeftOut& o : m.input.left_out)
      text += html::escaped(fmt::format(" Left out: {:g} m around {} m.", o.radius, place_text(o.at)));
    body += html::section("Differences from finite elements",
                          text + "</p>\n" + html::table(fem_table(m.runs, m.fem)));
  }
  if (!m.input.thresholds.empty()) body += html::section("Thresholds", html::table(m.checked.rows, false));
  return body;
}

std::string development_section(const Material& m) {
  if (m.fields.empty()) return "";
  const std::string text = development_part(m.runs, m.fields.front(), m.input, m.folder);
  return text.empty() ? "" : html::section("How it develops", text);
}

std::string body_of(const Material& m) {
  std::string body = html::section("Runs", html::table(run_table(m.runs)));
  body += stages_section(m.labels, summaries_of(m));
  body += html::section("The case", pictures_of({draw_case(m.runs.front(), m.folder)}));
  body += stress_sections(m) + probe_section(m) + water_section(m) + difference_sections(m) +
          development_section(m);
  if (const Rows rows = settings_table(m.runs); rows.size() > 1)
    body += html::section("Settings that differ", html::table(rows, false));
  for (std::size_t i = 0; i < m.input.studies.size(); ++i)
    body += study_section(m.input.studies[i], m.folder, fmt::format("study_{}_", i + 1));
  return body + html::section("How to reproduce", how_to_reproduce(m.input, m.runs));
}

Json json_of(const Material& m) {
  Json json = {{"runs", Json::object()}, {"thresholds", m.checked.json}, {"warnings", m.warnings}};
  for (std::size_t i = 0; i < m.runs.size(); ++i) json["runs"][m.runs[i].label] = m.summaries[i];
  for (const fs::path& study : m.input.studies) json["studies"].push_back(to_json(read_study(study)));
  return json;
}

}  // namespace

std::vector<std::string> write_report(const ReportInput& input, const fs::path& folder) {
  require_reportable(input.runs);
  for (const fs::path& study : input.studies) read_study(study);  // before anything is drawn
  if (input.fem)
    for (const FinishedRun& run : input.runs) require_same_problem(run, *input.fem);
  const Material m = load(input, folder);
  make_folder(folder);

  const std::string notes =
      m.warnings.empty() ? "" : "<div class=\"warnings\" role=\"note\">" + list(m.warnings) + "</div>\n";
  const std::string body = body_of(m);
  write_page(html::page(m.scene().title, head_of(m) + notes + html::contents(body) + body), input.single_file,
             folder);
  write_file(folder / "report.json", json_of(m).dump(2) + "\n");
  if (!input.summary.empty())
    write_file(input.summary, markdown_summary(input, m.runs, m.fem, m.checked, m.warnings));
  return m.checked.failed;
}

}  // namespace porosph::render
