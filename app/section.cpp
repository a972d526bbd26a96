// porosph section: values along a line through the soil.
#include <fmt/format.h>

#include <boost/algorithm/string.hpp>
#include <iostream>

#include "app/command.hpp"
#include "app/field_help.hpp"
#include "app/numbers.hpp"
#include "app/picture_options.hpp"
#include "render/run/run_panel.hpp"
#include "render/run/section_chart.hpp"
#include "render/run/shown_field.hpp"
#include "solver/space/place_text.hpp"
#include "vtk_io/finished_run/norms.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::app {

using namespace render;

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> runs, labels, fields, times, via;
  std::string from, to, vertical, level, fem, out;
  int points = 0;
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  po::options_description options;
  options.add_options()("run", po::value(&o.runs)->required(), "folders of runs")(
      "vertical", po::value(&o.vertical)->value_name("X"), "along the vertical at x = X [m]")(
      "level", po::value(&o.level)->value_name("Y"), "along the level at y = Y [m]")(
      "from", po::value(&o.from)->value_name("X,Y"), "along a straight line or polyline from here [m]")(
      "via", po::value(&o.via)->value_name("X,Y"), "a corner of the polyline; may be given again, in order")(
      "to", po::value(&o.to)->value_name("X,Y"), "to here [m]")(
      "field", po::value(&o.fields)->value_name("NAME[:COMPONENT]"),
      (field_help() + "; may be given again (default: EffectiveStress:YY)").c_str())(
      "time", po::value(&o.times)->value_name("T|last|all"),
      "the frame nearest to T seconds, the last one, or all; may be given again (default: last)")(
      "fem", po::value(&o.fem)->value_name("DIR"), "also the finite-element reference in this folder")(
      "label", po::value(&o.labels)->value_name("TEXT"),
      "what to call a run; given once for each run, in their order (default: the folder's name)")(
      "points", po::value(&o.points)->value_name("N"),
      "laid out over the line, from 2 to 100000 (default: two per spacing of the particles)")(
      "out", po::value(&o.out)->value_name("FILE.png"),
      "the chart: .png, .svg or .pdf; the table goes beside it as FILE.csv (default: section.png beside the "
      "first "
      "run's series)");
  po::positional_options_description positional;
  positional.add("run", -1);
  po::variables_map values;
  if (!parse(
          arguments, options, positional, "section RUN... [options]",
          "  porosph section results/foundation --vertical 7.5\n"
          "  porosph section results/foundation --level 0.1 --field EffectiveStress:YY --field MeanPressure\n"
          "  porosph section results/foundation --from 0,2 --to 15,8 --time 0.5 --time last --out "
          "slope.png\n",
          values))
    return std::nullopt;
  if (values.count("points") > 0 && (o.points < 2 || o.points > 100'000))
    throw UsageError(fmt::format("--points = {}: must be from 2 to 100000", o.points));
  if (o.fields.empty()) o.fields = {"EffectiveStress:YY"};
  if (o.times.empty()) o.times = {"last"};
  return o;
}

Point read_point(const std::string& option, const std::string& text) {
  std::vector<std::string> parts;
  boost::split(parts, text, boost::is_any_of(","));
  if (parts.size() != 2) throw UsageError(fmt::format("{} = {}: must be X,Y", option, text));
  return {read_number(option, parts[0]), read_number(option, parts[1])};
}

SectionLine line_of(const Options& o) {
  const bool polyline = !o.from.empty() || !o.to.empty() || !o.via.empty();
  if ((o.vertical.empty() ? 0 : 1) + (o.level.empty() ? 0 : 1) + (polyline ? 1 : 0) != 1)
    throw UsageError("a section needs one of --vertical X, --level Y, or --from X,Y with --to X,Y");
  if (!o.vertical.empty())
    return {.kind = SectionLine::vertical, .points = {}, .at = read_number("--vertical", o.vertical)};
  if (!o.level.empty())
    return {.kind = SectionLine::level, .points = {}, .at = read_number("--level", o.level)};
  if (o.from.empty() || o.to.empty())
    throw UsageError("--from X,Y and --to X,Y are needed together; --via X,Y adds corners between them");
  SectionLine line{.kind = SectionLine::polyline, .points = {read_point("--from", o.from)}, .at = 0};
  for (const std::string& corner : o.via) line.points.push_back(read_point("--via", corner));
  line.points.push_back(read_point("--to", o.to));
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
    if (line.points[i] == line.points[i + 1])
      throw UsageError(
          fmt::format("the section has the point {} twice in a row", place_text(line.points[i])));
  return line;
}

std::vector<std::size_t> choose_frames(const Series& series, const std::vector<std::string>& times) {
  std::vector<std::size_t> frames;
  const auto add = [&](std::size_t frame) {
    if (std::find(frames.begin(), frames.end(), frame) == frames.end()) frames.push_back(frame);
  };
  for (const std::string& time : times) {
    if (time == "last")
      add(series.frames.size() - 1);
    else if (time == "all")
      for (std::size_t i = 0; i < series.frames.size(); ++i) add(i);
    else
      add(frame_at(series, read_number("--time", time)));
  }
  return frames;
}

void print_force(const RunSection& section, const std::string& stress, const char* what) {
  if (!can_show(section.pieces.front().values, stress)) return;
  const SectionForce force = force_through(section.pieces, stress);
  fmt::print("  {:16} normal {:.5g} kN/m, shear {:.5g} kN/m\n", what, force.normal * 1e-3,
             force.shear * 1e-3);
}

void print(const RunSection& section) {
  std::size_t points = 0;
  for (const SectionPiece& piece : section.pieces) points += piece.along.size();
  fmt::print("{} at {:.6g} s: {} points in {} stretch{} of soil\n", section.label, section.time, points,
             section.pieces.size(), section.pieces.size() == 1 ? "" : "es");
  print_force(section, "EffectiveStress", "effective stress:");
  print_force(section, "TotalStress", "total stress:");
  if (has_field(section.pieces.front().values, "DarcyVelocity"))
    fmt::print("  {:16} {:.5g} m2/s to the left of the line\n", "discharge:", flow_through(section.pieces));
}

}  // namespace

int section_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  const SectionLine line = line_of(*o);
  std::vector<FieldSelection> fields;
  for (const std::string& field : o->fields) fields.push_back(parse_selection(field));
  std::vector<FinishedRun> runs;
  for (const std::string& run : o->runs) runs.push_back(open_run(run));
  set_labels(runs, o->labels);
  const std::vector<std::string> labels = run_labels(runs);
  std::optional<FemReference> fem;
  if (!o->fem.empty()) {
    fem.emplace(o->fem);
    for (const FinishedRun& run : runs) require_same_problem(run, *fem);
  }
  const fs::path out = o->out.empty() ? runs.front().folder / "section.png" : fs::path(o->out);
  require_picture_name(out);

  std::vector<RunSection> sections, references;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::vector<std::size_t> frames = choose_frames(runs[i].series, o->times);
    for (const std::size_t frame : frames) {
      const std::string label =
          labels[i] + (frames.size() > 1 ? ", " + time_text(runs[i].series.frames[frame].time) : "");
      sections.push_back(section_of(runs[i], label, frame_of(runs[i], frame), line, o->points, fields));
      print(sections.back());
    }
  }
  if (runs.front().scene)
    if (auto exact = exact_section(*runs.front().scene, sections.front()))
      references.push_back(std::move(*exact));
  if (fem) references.push_back(fem_section(*fem, sections.front()));

  std::vector<Chart> charts;
  for (const FieldSelection& field : fields)
    charts.push_back(section_chart(line, sections, references, field));
  std::string title = runs.front().scene ? runs.front().scene->title : "";
  title += (title.empty() ? "Section " : ", section ") + line.text();
  if (out.has_parent_path()) make_folder(out.parent_path());
  save_charts(section_figure(line, std::move(charts), title), out);
  std::vector<RunSection> all = sections;
  all.insert(all.end(), references.begin(), references.end());
  const fs::path table = fs::path(out).replace_extension(".csv");
  write_file(table, section_csv(all, fields));
  std::cout << out.string() << '\n' << table.string() << '\n';
  return Exit::done;
}

}  // namespace porosph::app
