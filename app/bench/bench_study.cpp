#include "app/bench/bench_study.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>

#include "app/bench/asked.hpp"
#include "app/bench/machine.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::bench {

using namespace render;

namespace {

using Rows = std::vector<std::vector<std::string>>;

Study frame(const BenchOptions& options, const std::string& command) {
  return {.title = "Speed",
          .lead = fmt::format("What run time buys, measured on: {}. Up to {} threads{}.", describe_machine(),
                              options.threads, options.quick ? "; a quick look with few repetitions" : ""),
          .sections = {},
          .files = {},
          .command = command};
}

StudySection asked_section(const Rows& rows) {
  return {.heading = "What is asked and what was measured",
          .paragraphs = {"Medians of repeated runs that take turns; with half the range from the lowest to "
                         "the highest. Ratios hold better than absolute numbers where other programs share "
                         "the machine."},
          .tables = {{.caption = "", .rows = rows, .numbers = false}},
          .pictures = {}};
}

StudySection left_out_section(const std::vector<std::string>& left_out) {
  Rows rows = {{"Left out"}};
  for (const std::string& what : left_out) rows.push_back({what});
  return {.heading = "What was left out",
          .paragraphs = {},
          .tables = {{.caption = "", .rows = rows}},
          .pictures = {}};
}

std::string on_terminal(const Rows& asked, const Bench& bench) {
  std::string text = describe_machine() + "\n";
  for (std::size_t i = 1; i < asked.size(); ++i)
    text += fmt::format("{}\n    asked: {}   measured: {}   reached: {}\n", asked[i][0], asked[i][1],
                        asked[i][2], asked[i][3]);
  for (const std::string& what : bench.left_out()) text += "left out: " + what + "\n";
  return text + (bench.options().out / "index.html").string() + "\n";
}

}  // namespace

const std::vector<std::string>& measurement_names() {
  static const std::vector<std::string> names = {"throughput", "phases", "work-precision"};
  return names;
}

std::string run_bench(const BenchOptions& options, const std::vector<std::string>& only,
                      const std::string& command) {
  Bench bench(options);
  make_folder(options.out);
  const auto wanted = [&](const std::string& name) {
    return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
  };
  Study study = frame(options, command);
  std::optional<Throughput> throughput;
  std::optional<WorkPrecision> work;
  const auto add = [&](StudySection section, const std::string& file) {
    study.sections.push_back(std::move(section));
    study.files.push_back(file);
  };
  if (wanted("throughput")) {
    throughput = measure_throughput(bench);
    add(show_throughput(*throughput, bench), "throughput.csv");
  }
  if (wanted("phases")) add(show_phases(measure_phases(bench), bench), "phases.csv");
  if (wanted("work-precision")) {
    work = measure_work_precision(bench);
    add(show_work_precision(*work, bench), "work_precision.csv");
  }
  const Rows asked = asked_table(throughput, work, options.threads);
  if (asked.size() > 1) study.sections.insert(study.sections.begin(), asked_section(asked));
  if (!bench.left_out().empty()) study.sections.push_back(left_out_section(bench.left_out()));
  write_study(study, options.out);
  return on_terminal(asked, bench);
}

}  // namespace porosph::bench
