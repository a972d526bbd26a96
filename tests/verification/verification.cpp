// The table is written by the tests themselves: POROSPH_WRITE_DOCS=1 verification
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "tests/verification/verification.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

namespace porosph::verification {
namespace {

struct Row {
  Measurement what;
  std::string found, allowed;
};

std::vector<Row>& rows() {
  static std::vector<Row> all;
  return all;
}

/// Fit for a shell.
std::string quoted(const std::string& setting) {
  const bool plain = setting.find_first_of(" [{'") == std::string::npos;
  return plain ? setting : '"' + setting + '"';
}

/// From the project's root; a shipped case may serve as it is.
std::string case_file(const std::string& name) {
  const std::string shipped = fmt::format("cases/{}.toml", name);
  if (std::filesystem::exists(std::filesystem::path(POROSPH_SOURCE_DIR) / shipped)) return shipped;
  return fmt::format("cases/verification/{}.toml", name);
}

std::string command(const Measurement& m) {
  std::string text = "porosph " + m.subcommand + " " + case_file(m.name);
  for (const std::string& setting : m.settings) text += " --set " + quoted(setting);
  return text;
}

const char* introduction =
    "# Verification\n"
    "\n"
    "Every case below is computed by the `verification` tests and compared with something that does not come "
    "from\n"
    "particles: an exact solution, a conservation law, a symmetry. The tests fail where the error exceeds "
    "what is\n"
    "allowed. They also write these tables, so do not edit them: build the preset `tests`, then\n"
    "\n"
    "```sh long\n"
    "cmake --preset tests && cmake --build --preset tests --target verification\n"
    "POROSPH_WRITE_DOCS=1 build/tests/bin/verification\n"
    "```\n"
    "\n"
    "The command in the last column runs the case by itself. Of the patch and of the rotation the tests "
    "impose fields\n"
    "or motions that a case file cannot; their commands show the scene.\n";

void write_section(std::ostream& out, const std::string& name) {
  out << fmt::format("\n## {}\n\n`{}`\n\n", scene(name).title, case_file(name))
      << "| Quantity | Compared with | Resolution | Error | Allowed | Order | Run it |\n"
      << "|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows())
    if (row.what.name == name)
      out << fmt::format("| {} | {} | {} | {} | {} | {} | `{}` |\n", row.what.quantity, row.what.reference,
                         row.what.resolution, row.found, row.allowed, row.what.order, command(row.what));
}

void write_tables() {
  std::ofstream file(std::string(POROSPH_SOURCE_DIR) + "/docs/verification.md");
  file << introduction;
  std::set<std::string> names;
  for (const Row& row : rows()) names.insert(row.what.name);
  for (const std::string& name : names) write_section(file, name);
  if (!file) throw std::runtime_error("docs/verification.md cannot be written");
}

using Listener = Catch::TestEventListenerBase;  // another class's name in Catch2 3

struct TableWriter final : Listener {
  using Listener::Listener;
  /// The cases are too small to share, and tests run beside each other.
  void testRunStarting(const Catch::TestRunInfo&) override { omp_set_num_threads(1); }
  void testRunEnded(const Catch::TestRunStats& stats) override {
    const bool all_well = stats.totals.testCases.failed == 0 && !stats.aborting;
    if (std::getenv("POROSPH_WRITE_DOCS") && all_well) write_tables();
  }
};
CATCH_REGISTER_LISTENER(TableWriter)

}  // namespace

Case scene(const std::string& name, const Settings& settings) {
  return read_case(std::filesystem::path(POROSPH_SOURCE_DIR) / case_file(name), settings);
}

void run_to_end(Simulation& simulation, const RunWatch& watch) {
  const RunOutcome outcome = run(simulation, watch);
  INFO(outcome.message);
  REQUIRE((outcome.status == RunStatus::completed || outcome.status == RunStatus::equilibrium));
}

double mean_force_on_footing(Simulation& simulation, double begin) {
  double sum = 0;
  int count = 0;
  RunWatch watch;
  watch.progress = [&](const Simulation& now) {
    if (now.time() - begin < 0.8 * (now.scene().time.end - begin)) return;
    sum += now.footings()[0].force(), ++count;
  };
  run_to_end(simulation, watch);
  return sum / count;
}

std::string percent(double fraction) {
  return fraction < 1 ? fmt::format("{:.2g} %", 100 * fraction) : fmt::format("{:.0f} %", 100 * fraction);
}
std::string scientific(double value) { return fmt::format("{:.1e}", value); }
std::string metres(double spacing) { return fmt::format("spacing {:g} m", spacing); }

void expect(const Measurement& what, double error, double largest_allowed, std::string (*text)(double)) {
  INFO(what.name << ", " << what.quantity << ", " << what.resolution << ": " << error);
  CHECK(error <= largest_allowed);
  note(what, text(error), text(largest_allowed));
}

void note(const Measurement& what, const std::string& found, const std::string& allowed) {
  rows().push_back({what, found, allowed});
}

std::vector<double> coarse_and_fine(double coarse, double fine) {
  const bool at_length = std::getenv("POROSPH_NIGHTLY") || std::getenv("POROSPH_WRITE_DOCS");
  return at_length ? std::vector{coarse, fine} : std::vector{coarse};
}

double fitted_order(const std::vector<double>& spacings, const std::vector<double>& errors) {
  const auto n = static_cast<double>(spacings.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < spacings.size(); ++i) {
    const double lx = std::log(spacings[i]), ly = std::log(errors[i]);
    x += lx, y += ly, xx += lx * lx, xy += lx * ly;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace porosph::verification
