// porosph grid: values of a run on a regular grid.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "app/command.hpp"
#include "app/field_help.hpp"
#include "app/numbers.hpp"
#include "solver/analysis/derived_fields.hpp"
#include "solver/analysis/grid_values.hpp"
#include "vtk_io/finished_run/finished_run.hpp"
#include "vtk_io/grid_vti.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::string run, time, out;
  std::vector<std::string> fields;
  double spacing = 0;
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  po::options_description options;
  options.add_options()("run", po::value(&o.run)->required(), "the folder of a run")(
      "spacing", po::value(&o.spacing)->value_name("LENGTH"),
      "of the grid [m] (default: half the spacing of the particles)")(
      "time", po::value(&o.time)->value_name("T|last")->default_value("last"),
      "the frame nearest to T seconds, or the last one")(
      "field", po::value(&o.fields)->value_name("NAME"),
      ("a field to be computed besides those of the series; may be given again: " + field_help()).c_str())(
      "out", po::value(&o.out)->value_name("FILE.vti"), "the grid (default: grid.vti in the run's folder)");
  po::positional_options_description positional;
  positional.add("run", 1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "grid RUN [options]",
             "  porosph grid results/foundation\n"
             "  porosph grid results/foundation --spacing 0.1 --field VonMisesStress --out foundation.vti\n",
             values))
    return std::nullopt;
  if (values.count("spacing") > 0 && !(o.spacing > 0 && o.spacing < 1e9))
    throw UsageError(fmt::format("--spacing = {}: must be > 0", o.spacing));
  if (!o.out.empty() && fs::path(o.out).extension() != ".vti")
    throw UsageError(fmt::format("--out = {}: the name of a grid must end in .vti", o.out));
  return o;
}

}  // namespace

int grid_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  const FinishedRun run = open_run(o->run);
  const std::size_t number =
      o->time == "last" ? run.series.frames.size() - 1 : frame_at(run.series, read_number("--time", o->time));
  const Frame frame = frame_of(run, number);
  const Case* scene = run.scene ? &*run.scene : nullptr;
  const double spacing = o->spacing > 0 ? o->spacing : scene != nullptr ? scene->particles.spacing / 2 : 0;
  if (!(spacing > 0)) throw UsageError("--spacing is needed: the run has no case.toml that tells it");
  std::vector<FieldSelection> fields;
  for (const std::string& name : o->fields) fields.push_back({name, ""});
  GridValues grid = values_on_grid(frame, scene, spacing, fields);
  for (const FieldSelection& field : fields)
    if (!has_field(grid.values, field.name))
      if (auto derived = derived_field(grid.values, field.name))
        grid.values.fields.push_back(std::move(*derived));
  const fs::path path = o->out.empty() ? run.folder / "grid.vti" : fs::path(o->out);
  if (path.has_parent_path()) make_folder(path.parent_path());
  write_grid_vti(path, grid);
  fmt::print("{}: {} x {} nodes, {} of them in the soil, at {:g} s\n", path.string(), grid.columns, grid.rows,
             grid.values.points.size() / 3, grid.values.time);
  return Exit::done;
}

}  // namespace porosph::app
