// porosph compare: two runs side by side, with their difference.
#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "app/command.hpp"
#include "app/field_help.hpp"
#include "app/left_out.hpp"
#include "app/numbers.hpp"
#include "app/picture_options.hpp"
#include "app/range.hpp"
#include "render/report/comparison.hpp"
#include "render/run/shown_field.hpp"
#include "vtk_io/finished_run/frame_pair.hpp"
#include "vtk_io/paraview_script.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::app {

using namespace render;

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> runs, labels, fields, left_out;
  std::string fem, out, time, range, difference_range, style;
  double deformation = 1;
  bool different_times = false;
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  po::options_description options;
  options.add_options()("run", po::value(&o.runs)->required(), "two folders of runs")(
      "fem", po::value(&o.fem)->value_name("DIR"),
      "also against the finite-element reference in this folder")(
      "leave-out", po::value(&o.left_out)->value_name("X,Y,RADIUS"),
      "place [m] that does not count against finite elements, such as a toe; may be given again")(
      "field", po::value(&o.fields)->value_name("NAME[:COMPONENT]"),
      (field_help() + "; may be given again (default: EffectiveStress:YY, TotalStress:YY, Displacement:Y)")
          .c_str())(
      "time", po::value(&o.time)->value_name("T|last|common")->default_value("last"),
      "the frames nearest to T seconds, the last ones, or those of the last time that both runs have")(
      "allow-different-times", po::bool_switch(&o.different_times),
      "compare also where the times differ by more than a time step and neither run is at rest")(
      "label", po::value(&o.labels)->value_name("TEXT"),
      "what to call a run; given twice, in the order of the runs (default: the folder's "
      "name)")("range", po::value(&o.range)->value_name("LOW,HIGH"),
               "of the runs' colours, in the unit of the colour bar (default: all values, rounded)")(
      "difference-range", po::value(&o.difference_range)->value_name("LOW,HIGH"),
      "of the differences' colours, in the unit of the bar (default: each picture's own)")(
      "style", po::value(&o.style)->value_name("particles|bands|isolines")->default_value("particles"),
      "each particle in its colour, bands of colour with labelled isolines, or isolines on the particles")(
      "deform", po::value(&o.deformation)->value_name("FACTOR")->default_value(1),
      "displacements are drawn this many times")(
      "out", po::value(&o.out)->value_name("DIR")->default_value("results/compare"),
      "folder for pictures and tables");
  po::positional_options_description positional;
  positional.add("run", -1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "compare RUN_A RUN_B [options]",
             "  porosph compare results/conventional results/proposed --field TotalStress:YY\n"
             "  porosph compare results/a results/b --fem results/embankment_fem --leave-out 10,6,1\n",
             values))
    return std::nullopt;
  if (o.runs.size() != 2) throw UsageError(fmt::format("two runs are compared, not {}", o.runs.size()));
  if (!std::isfinite(o.deformation)) throw UsageError("--deform must be a finite number");
  if (o.fields.empty()) o.fields = {"EffectiveStress:YY", "TotalStress:YY", "Displacement:Y"};
  return o;
}

FramePair choose_frames(const FinishedRun& a, const FinishedRun& b, const Options& o) {
  if (o.time == "common") return common_frames(a, b);
  const FramePair frames =
      o.time == "last" ? last_frames(a, b) : frames_at(a, b, read_number("--time", o.time));
  if (!o.different_times) require_fair(a, b, frames);
  return frames;
}

void print(const std::string& heading, const std::vector<FieldNorms>& all) {
  if (all.empty()) return;
  fmt::print("{}\n  {:28} {:>18}   {}\n", heading, "field", "relative L2", "largest difference");
  for (const FieldNorms& n : all)
    fmt::print("  {:28} {:>18}   {}\n", shown_name(n.field), relative_text(n.relative_l2), largest_text(n));
}

}  // namespace

int compare_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  ComparisonChoice choice{.pictures = {},
                          .deformation = o->deformation,
                          .style = read_style(o->style),
                          .range = read_range("--range", o->range),
                          .difference_range = read_range("--difference-range", o->difference_range),
                          .left_out = read_left_out(o->left_out)};
  for (const std::string& field : o->fields) choice.pictures.push_back(parse_selection(field));
  std::vector<FinishedRun> runs = {open_run(o->runs[0]), open_run(o->runs[1])};
  set_labels(runs, o->labels);
  const FinishedRun &a = runs[0], &b = runs[1];
  std::optional<FemReference> fem;
  if (!o->fem.empty()) fem.emplace(o->fem);
  const FramePair frames = choose_frames(a, b, *o);
  const Comparison c = compare_runs(a, frames.a, b, frames.b, fem, choice, o->out);
  const std::vector<std::string> labels = run_labels(runs);
  write_norms(c, labels[0], labels[1], o->out);
  fmt::print("{} at {:.6g} s and {} at {:.6g} s{}, {} points, {}\n", labels[0], c.time_a, labels[1], c.time_b,
             is_fair(a, b, frames) ? "" : ", times that differ", c.points,
             c.particle_by_particle ? "particle by particle" : "interpolated, exact for linear fields");
  print(fmt::format("{} against {}", labels[0], labels[1]), c.a_against_b);
  print(labels[0] + " against finite elements", c.a_against_fem);
  print(labels[1] + " against finite elements", c.b_against_fem);
  write_file(fs::path(o->out) / compare_script,
             paraview_comparison_script(fs::absolute(o->out), fs::relative(a.folder, o->out),
                                        fs::relative(b.folder, o->out)));
  for (const std::string& file : c.pictures) fmt::print("{}\n", (fs::path(o->out) / file).string());
  for (const char* file : {"comparison.csv", "comparison.json", compare_script})
    fmt::print("{}\n", (fs::path(o->out) / file).string());
  return Exit::done;
}

}  // namespace porosph::app
