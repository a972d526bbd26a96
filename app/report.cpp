// porosph report: a page of pictures and tables of runs.
#include "render/report/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <thread>

#include "app/command.hpp"
#include "app/field_help.hpp"
#include "app/left_out.hpp"
#include "app/numbers.hpp"
#include "app/range.hpp"
#include "render/report/study.hpp"
#include "vtk_io/run_folder/safety_files.hpp"

namespace porosph::app {

using namespace render;

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> runs, labels, left_out, thresholds, fields, ranges, verticals, levels;
  std::string fem, out, summary;
  int instants = 0;
  bool single_file = false;
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  po::options_description options;
  options.add_options()(
      "run", po::value(&o.runs)->required(),
      "folders of runs of one body, and of studies that go with them (porosph safety, bench, stability)")(
      "label", po::value(&o.labels)->value_name("TEXT"),
      "what to call a run; given once for each run, in their order (default: the folder's "
      "name)")("fem", po::value(&o.fem)->value_name("DIR"),
               "also against the finite-element reference in this folder")(
      "leave-out", po::value(&o.left_out)->value_name("X,Y,RADIUS"),
      "place [m] that does not count against finite elements, such as a toe; may be given again")(
      "field", po::value(&o.fields)->value_name("NAME[:COMPONENT]"),
      (field_help() +
       "; may be given again, the first one is also drawn over time and along sections (default: "
       "vertical stresses and displacement)")
          .c_str())(
      "range", po::value(&o.ranges)->value_name("LOW,HIGH"),
      "of the colours of a --field, in the unit of its colour bar; given once for each, in their "
      "order (default: by the values)")(
      "vertical", po::value(&o.verticals)->value_name("X"),
      "a section along the vertical at x = X [m]; may be given again (default: through the probes)")(
      "level", po::value(&o.levels)->value_name("Y"),
      "a section along the level at y = Y [m]; may be given again")(
      "instants", po::value(&o.instants)->value_name("N")->default_value(20),
      "pictures of the player of each run; 0: none")("single-file", po::bool_switch(&o.single_file),
                                                     "put the pictures into index.html")(
      "summary", po::value(&o.summary)->value_name("FILE.md"),
      "also write a summary in Markdown, as pages of continuous integration show it")(
      "fail-if", po::value(&o.thresholds)->value_name("PATH>NUMBER"),
      "exit with status 1 if this holds for a number of a run's summary.json (fem.FIELD.relative_l2 with "
      "--fem); "
      ">, >=, < or <=; may be given again")("out",
                                            po::value(&o.out)->value_name("DIR")->default_value("report"),
                                            "folder for index.html and its pictures");
  po::positional_options_description positional;
  positional.add("run", -1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "report RUN... [STUDY...] [options]",
             "  porosph report results/foundation\n"
             "  porosph report results/foundation --single-file --summary summary.md\n"
             "  porosph report results/foundation --field StressObliquity --range 0,40 --vertical 7.5\n"
             "  porosph report results/levee results/levee_safety --out results/levee_report\n"
             "  porosph report results/a results/b --out report --fail-if "
             "'errors.EffectiveStress_YY.relative_l2>0.02'\n",
             values))
    return std::nullopt;
  if (o.instants < 0 || o.instants > 1000)
    throw UsageError(fmt::format("--instants = {}: must be from 0 to 1000", o.instants));
  if (!o.ranges.empty() && o.ranges.size() != o.fields.size())
    throw UsageError(fmt::format("{} --range for {} --field: give one for each, in their order",
                                 o.ranges.size(), o.fields.size()));
  if (!o.verticals.empty() && !o.levels.empty())
    throw UsageError("--vertical and --level do not go together: the sections of a report share one axis");
  return o;
}

std::vector<ReportField> fields_of(const Options& o) {
  std::vector<ReportField> fields;
  for (std::size_t i = 0; i < o.fields.size(); ++i)
    fields.push_back(
        {parse_selection(o.fields[i]), o.ranges.empty() ? std::nullopt : read_range("--range", o.ranges[i])});
  return fields;
}

std::vector<SectionLine> sections_of(const Options& o) {
  std::vector<SectionLine> lines;
  for (const std::string& x : o.verticals)
    lines.push_back({.kind = SectionLine::vertical, .points = {}, .at = read_number("--vertical", x)});
  for (const std::string& y : o.levels)
    lines.push_back({.kind = SectionLine::level, .points = {}, .at = read_number("--level", y)});
  return lines;
}

/// The processor's name, as Linux tells it.
std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return "a processor that has no name";
}

/// SOURCE_DATE_EPOCH, where it is set, is the time, so that pages can be made again byte for byte.
std::string made_now() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t now =
      epoch != nullptr ? static_cast<std::time_t>(std::strtoll(epoch, nullptr, 10)) : std::time(nullptr);
  char text[32] = "";
  std::tm parts{};
  if (gmtime_r(&now, &parts) != nullptr) std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  return fmt::format("Made {} by Porosph {} on {}, {} threads.", text, POROSPH_VERSION, processor(),
                     std::thread::hardware_concurrency());
}

}  // namespace

int report_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  ReportInput input;
  input.command = command_line("report", arguments);
  input.made = made_now();
  input.single_file = o->single_file;
  input.summary = o->summary;
  input.fields = fields_of(*o);
  input.sections = sections_of(*o);
  input.instants = static_cast<std::size_t>(o->instants);
  input.left_out = read_left_out(o->left_out);
  for (const std::string& text : o->thresholds) input.thresholds.push_back(parse_threshold(text));
  for (const std::string& folder : o->runs)
    if (is_study(folder))
      input.studies.push_back(folder);
    else
      input.runs.push_back(open_run(folder));
  for (const FinishedRun& run : input.runs)
    if (run.summary)
      for (const Summary::Stage& stage : run.summary->stages)
        if (const fs::path study = run.folder / safety_folder(stage.name); stage.safety && is_study(study))
          input.studies.push_back(study);
  if (input.runs.empty())
    throw UsageError(fmt::format("no run among the folders; the page of a study alone is {}",
                                 (fs::path(o->runs.front()) / "index.html").string()));
  set_labels(input.runs, o->labels);
  if (!o->fem.empty()) input.fem.emplace(o->fem);
  const std::vector<std::string> failed = write_report(input, o->out);
  fmt::print("{}\n", (fs::path(o->out) / "index.html").string());
  std::fflush(stdout);
  for (const std::string& text : failed) std::cerr << "porosph: threshold failed: " << text << '\n';
  return failed.empty() ? Exit::done : Exit::failed_threshold;
}

}  // namespace porosph::app
