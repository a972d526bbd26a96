// porosph profile: the surface of soil that has moved.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "app/command.hpp"
#include "app/numbers.hpp"
#include "app/picture_options.hpp"
#include "render/chart.hpp"
#include "render/run/run_panel.hpp"
#include "solver/analysis/frame_values.hpp"
#include "solver/analysis/surface_profile.hpp"
#include "vtk_io/finished_run/finished_run.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/csv.hpp"

namespace porosph::app {

using namespace render;

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> runs, labels, times;
  std::string out;
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  po::options_description options;
  options.add_options()("run", po::value(&o.runs)->required(), "folders of runs")(
      "time", po::value(&o.times)->value_name("T|last|all"),
      "the frame nearest to T seconds, the last one, or all; may be given again (default: last)")(
      "label", po::value(&o.labels)->value_name("TEXT"),
      "what to call a run; given once for each run, in their order (default: the folder's name)")(
      "out", po::value(&o.out)->value_name("FILE.png"),
      "the chart: .png, .svg or .pdf; the table goes beside it as FILE.csv (default: profile.png beside the "
      "first "
      "run's series)");
  po::positional_options_description positional;
  positional.add("run", -1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "profile RUN... [options]",
             "  porosph profile results/column_collapse --time all\n"
             "  porosph profile results/coarse results/fine --out runout.pdf\n",
             values))
    return std::nullopt;
  if (o.times.empty()) o.times = {"last"};
  return o;
}

struct Line {
  std::string label;
  double time;
  SurfaceProfile profile;
};

std::vector<std::size_t> choose_frames(const Series& series, const std::vector<std::string>& times) {
  std::vector<std::size_t> frames;
  for (const std::string& time : times) {
    if (time == "all")
      for (std::size_t i = 0; i < series.frames.size(); ++i) frames.push_back(i);
    else
      frames.push_back(time == "last" ? series.frames.size() - 1
                                      : frame_at(series, read_number("--time", time)));
  }
  std::ranges::sort(frames);
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

/// The case's spacing, or else the side of the first particle's square [m].
double column_width(const FinishedRun& run, const Frame& frame) {
  return run.scene ? run.scene->particles.spacing : std::sqrt(volumes_of(frame).at(0));
}

ChartSeries series_of(const Line& line) {
  ChartSeries series{.label = line.label, .x = {}, .y = {}};
  series.x = line.profile.x, series.y = line.profile.surface;
  return series;
}

/// The drawn outlines of the soils at t = 0.
std::vector<ChartSeries> outlines_of(const Case& scene) {
  std::vector<ChartSeries> lines;
  for (const SoilCase& soil : scene.soils) {
    ChartSeries line{.label = "",
                     .x = {},
                     .y = {},
                     .colour = Colour{150, 150, 150},
                     .line = LineStyle::dashed,
                     .width = 1.2};
    for (std::size_t i = 0; i <= soil.polygon.size(); ++i) {
      const Point& p = soil.polygon[i % soil.polygon.size()];
      line.x.push_back(p.x()), line.y.push_back(p.y());
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

void print(const Line& line) {
  const SurfaceProfile& p = line.profile;
  fmt::print(
      "{} at {:.6g} s: 95 % of the soil up to x = {:.5g} m, 99 % up to {:.5g} m, mean x {:.5g} m, {:.5g} "
      "m2\n",
      line.label, line.time, p.quantile95, p.quantile99, p.mean_x, p.area);
}

std::string table_of(const std::vector<Line>& lines) {
  std::string text = "run,time,x,surface,thickness\n";
  for (const Line& line : lines)
    for (std::size_t k = 0; k < line.profile.x.size(); ++k) {
      std::string cells = csv_line({line.label});
      cells.pop_back();
      for (const double value :
           {line.time, line.profile.x[k], line.profile.surface[k], line.profile.thickness[k]}) {
        cells += ',';
        append_csv_number(cells, value);
      }
      text += cells + "\n";
    }
  return text;
}

}  // namespace

int profile_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  std::vector<FinishedRun> runs;
  for (const std::string& run : o->runs) runs.push_back(open_run(run));
  set_labels(runs, o->labels);
  const std::vector<std::string> labels = run_labels(runs);
  const fs::path out = o->out.empty() ? runs.front().folder / "profile.png" : fs::path(o->out);
  require_picture_name(out);
  std::vector<Line> lines;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::vector<std::size_t> frames = choose_frames(runs[i].series, o->times);
    for (const std::size_t k : frames) {
      const Frame frame = frame_of(runs[i], k);
      const std::string label = runs.size() == 1     ? time_text(frame.time)
                                : frames.size() == 1 ? labels[i]
                                                     : labels[i] + ", " + time_text(frame.time);
      lines.push_back({label, frame.time, surface_profile(frame, column_width(runs[i], frame))});
      print(lines.back());
    }
  }
  Chart chart{.title = "Surface of the soil",
              .x = {.title = "x [m]"},
              .y = {.title = "y [m]"},
              .series = {},
              .references = {}};
  for (const Line& line : lines) chart.series.push_back(series_of(line));
  if (runs.front().scene)
    for (ChartSeries& outline : outlines_of(*runs.front().scene)) chart.series.push_back(std::move(outline));
  if (out.has_parent_path()) make_folder(out.parent_path());
  save_charts({.title = runs.front().scene ? runs.front().scene->title : "",
               .charts = {std::move(chart)},
               .columns = 1,
               .width = 1000,
               .height = 420},
              out);
  const fs::path table = fs::path(out).replace_extension(".csv");
  write_file(table, table_of(lines));
  std::cout << out.string() << '\n' << table.string() << '\n';
  return Exit::done;
}

}  // namespace porosph::app
