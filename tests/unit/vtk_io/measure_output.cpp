// Sizes and costs of the ways to write a frame, for docs/output-format.md: unit_vtk_io "[.measure-output]"
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <ctime>
#include <fstream>

#include "solver/case/case_file.hpp"
#include "solver/output/boundary_frame.hpp"
#include "solver/output/fields.hpp"
#include "tests/unit/run_folder/temporary_folder.hpp"
#include "vtk_io/frame_file.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

using namespace porosph;

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Processor time of what `work` does [s].
template <class Work>
double processor_seconds(Work work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// "0.74", "110".
std::string two_digits(double value) { return fmt::format("{:g}", std::stod(fmt::format("{:.2g}", value))); }

struct Way {
  std::string name;
  std::vector<std::string> fields;
  SeriesOptions options;
  std::vector<double> making, writing;  // [s]
  double bytes = 0;
};

std::vector<Way> ways() {
  const std::vector<std::string> usual = OutputCase{}.fields, few = {"EffectiveStress", "PorePressure"};
  std::vector<std::string> all = usual;
  for (const std::string& field : optional_field_names())
    if (field != "ExcessStress") all.push_back(field);  // it has no theory
  constexpr auto vtp = FrameFormat::poly_data, vtu = FrameFormat::unstructured_grid;
  return {{"`vtp`, `none`, the usual ten fields", usual, {vtp, Compression::none}, {}, {}},
          {"`vtp`, `lz4`, the usual ten fields", usual, {vtp, Compression::lz4}, {}, {}},
          {"`vtp`, `zlib`, the usual ten fields", usual, {vtp, Compression::zlib}, {}, {}},
          {"`vtu`, `zlib`, the usual ten fields", usual, {vtu, Compression::zlib}, {}, {}},
          {"`vtp`, `zlib`, the usual ten fields, `single`",
           usual,
           {vtp, Compression::zlib, FramePrecision::single},
           {},
           {}},
          {"`vtp`, `zlib`, two fields", few, {vtp, Compression::zlib}, {}, {}},
          {"`vtp`, `zlib`, all but `ExcessStress`", all, {vtp, Compression::zlib}, {}, {}}};
}

}  // namespace

TEST_CASE("measure what frames cost", "[.measure-output]") {
  omp_set_num_threads(1);
  Simulation simulation(read_case(std::string(POROSPH_SOURCE_DIR) + "/cases/embankment.toml"));
  for (int i = 0; i < 400; ++i) simulation.advance();
  const test::TemporaryFolder folder;
  std::vector<Way> all = ways();
  std::vector<double> steps;
  for (int repeat = 0; repeat < 9; ++repeat) {
    steps.push_back(processor_seconds([&] {
                      for (int i = 0; i < 20; ++i) simulation.advance();
                    }) /
                    20);
    simulation.accelerations();  // the next step's, which the velocities ask for: no cost of the frame
    for (Way& way : all) {
      Frame frame;
      const auto file = folder / "frame";
      way.making.push_back(processor_seconds([&] { frame = make_frame(simulation, way.fields); }));
      way.writing.push_back(processor_seconds([&] { write_frame(file, frame, way.options); }));
      way.bytes = static_cast<double>(std::filesystem::file_size(file));
    }
  }
  const double step = median(steps), particles = static_cast<double>(simulation.model().particles.size());
  std::string table =
      "| frame | bytes per particle | making it [time steps] | writing it [time steps] "
      "|\n|---|---|---|---|\n";
  for (const Way& way : all)
    table += fmt::format("| {} | {:.0f} | {} | {} |\n", way.name, way.bytes / particles,
                         two_digits(median(way.making) / step), two_digits(median(way.writing) / step));
  const std::string page = std::string(POROSPH_SOURCE_DIR) + "/docs/output-format.md",
                    mark = "<!-- measured -->\n";
  std::string text = read_file(page);
  const auto at = text.find(mark);
  REQUIRE(at != std::string::npos);
  write_file(page, text.substr(0, at + mark.size()) + table);
}
