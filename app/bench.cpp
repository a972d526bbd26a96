// porosph bench: run time against error, throughput, and where the time goes.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>

#include <iostream>
#include <optional>

#include "app/bench/bench_study.hpp"
#include "app/command.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;

struct Options {
  bench::BenchOptions bench;
  std::vector<std::string> only;
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  std::string out, cases;
  po::options_description options;
  options.add_options()("quick", "a minute at most, instead of ten")(
      "out", po::value(&out)->value_name("DIR")->default_value("results/bench"),
      "folder for index.html, its pictures and CSV files")(
      "only", po::value(&o.only)->value_name("NAME"),
      fmt::format("one measurement alone: {}; may be given again",
                  fmt::join(bench::measurement_names(), ", "))
          .c_str())("threads",
                    po::value(&o.bench.threads)->value_name("N")->default_value(omp_get_num_procs()),
                    "the most threads to measure with")(
      "particles", po::value(&o.bench.particles)->value_name("N")->default_value(o.bench.particles),
      "the most particles to measure with")(
      "cases", po::value(&cases)->value_name("DIR")->default_value(o.bench.cases.string()),
      "folder of the project's cases");
  po::variables_map values;
  if (!parse(arguments, options, {}, "bench [options]",
             "  porosph bench --quick\n"
             "  porosph bench --only throughput --out results/throughput\n",
             values))
    return std::nullopt;
  o.bench.quick = values.count("quick") > 0;
  o.bench.seconds = o.bench.quick ? 60 : 600;
  o.bench.out = out;
  o.bench.cases = cases;
  if (o.bench.threads < 1 || o.bench.threads > 1024)
    throw UsageError(fmt::format("--threads = {}: must be from 1 to 1024", o.bench.threads));
  if (o.bench.particles < 100)
    throw UsageError(fmt::format("--particles = {}: must be at least 100", o.bench.particles));
  const auto& names = bench::measurement_names();
  for (const std::string& name : o.only)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError(fmt::format("--only = {}: must be one of {}", name, fmt::join(names, ", ")));
  return o;
}

}  // namespace

int bench_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  std::cout << bench::run_bench(o->bench, o->only, command_line("bench", arguments));
  return Exit::done;
}

}  // namespace porosph::app
