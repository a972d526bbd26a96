// porosph import: a drawing becomes a case to fill in.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <optional>
#include <system_error>

#include "app/command.hpp"
#include "app/import/case_of_ground.hpp"
#include "app/numbers.hpp"
#include "app/say.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/units.hpp"
#include "solver/printable.hpp"
#include "solver/space/place_text.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::string drawing, out, unit, spacing, snap;
  std::vector<std::string> water, probes, roller, fixed, soils, skipped, names, empty;
  bool force = false;
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  po::options_description options;
  options.add_options()("drawing", po::value(&o.drawing)->required(), "a .dxf, .geojson, .csv or .wkt file")(
      "out", po::value(&o.out)->value_name("CASE.toml"),
      "the case to write (default: the drawing's name with .toml)")(
      "unit", po::value(&o.unit)->value_name("m|cm|mm|ft|in"),
      "of the drawing's coordinates (default: what the drawing says, else m)")(
      "spacing", po::value(&o.spacing)->value_name("LENGTH"),
      "between particles, as 0.5 or \"50 cm\" (default: for about 2500 particles)")(
      "snap", po::value(&o.snap)->value_name("LENGTH")->default_value("1 mm"),
      "corners nearer than this are made one")(
      "soil", po::value(&o.soils)->value_name("LAYER"),
      "a layer of soil, whatever it is called; all these may be given again")(
      "water", po::value(&o.water)->value_name("LAYER"),
      "a layer of water lines (default: names that begin with water)")(
      "probe", po::value(&o.probes)->value_name("LAYER"),
      "a layer of points to watch (default: names that begin with probe)")(
      "roller", po::value(&o.roller)->value_name("LAYER"),
      "a layer of smooth supports (default: names that begin with roller)")(
      "fixed", po::value(&o.fixed)->value_name("LAYER"),
      "a layer of rough supports (default: names that begin with fixed)")(
      "skip", po::value(&o.skipped)->value_name("LAYER"), "a layer to leave out")(
      "name", po::value(&o.names)->value_name("X,Y=SOIL"),
      "the soil around this point [m], where lines enclose regions and no text names one")(
      "empty", po::value(&o.empty)->value_name("X,Y"), "no soil is in the region around this point [m]")(
      "force", po::bool_switch(&o.force), "replace a case of that name");
  po::positional_options_description positional;
  positional.add("drawing", 1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "import FILE.dxf [options]",
             "  porosph import cases/drawings/levee.dxf --skip frame --out levee.toml\n"
             "  porosph import cases/drawings/levee.dxf --skip frame --skip probes --spacing \"25 cm\" --out "
             "fine.toml\n"
             "  porosph import cases/drawings/levee_lines.dxf --out lines.toml\n",
             values))
    return std::nullopt;
  return o;
}

/// Metres, given as a number or as text with a unit.
double read_length(const std::string& option, const std::string& text) {
  const bool plain = text.find_first_not_of("0123456789.+-eE") == std::string::npos;
  const Measure length = plain ? Measure{read_number(option, text), ""} : read_measure(text, "m");
  if (!length.fault.empty())
    throw UsageError(fmt::format("{} = {}: {}", option, printable(text), length.fault));
  if (!(length.value > 0 && length.value < 1e6))
    throw UsageError(fmt::format("{} = {}: must be > 0 and < 1e6 m", option, printable(text)));
  return length.value;
}

double metres_of(const std::string& unit) {
  const Measure one = read_measure("1 " + unit, "m");
  if (!one.fault.empty())
    throw UsageError(fmt::format("--unit = {}: must be one of {}", printable(unit), usual_units("m")));
  return one.value;
}

drawn::Label label_of(const std::string& option, const std::string& place, const std::string& name) {
  const auto comma = place.find(',');
  if (comma == std::string::npos)
    throw UsageError(fmt::format("{} = {}: must begin with X,Y", option, printable(place)));
  return {
      name, "", {read_number(option, place.substr(0, comma)), read_number(option, place.substr(comma + 1))}};
}

/// The regions that --name and --empty tell of.
std::vector<drawn::Label> told_regions(const Options& o) {
  std::vector<drawn::Label> told;
  for (const std::string& given : o.names) {
    const auto equals = given.find('=');
    if (equals == std::string::npos || equals + 1 == given.size())
      throw UsageError(fmt::format("--name = {}: must be X,Y=SOIL", printable(given)));
    told.push_back(label_of("--name", given.substr(0, equals), given.substr(equals + 1)));
  }
  for (const std::string& given : o.empty) told.push_back(label_of("--empty", given, ""));
  return told;
}

drawn::Options roles_of(const Options& o) {
  drawn::Options options;
  const auto add = [&](const std::vector<std::string>& layers, drawn::Role role) {
    for (const std::string& layer : layers) options.roles[layer] = role;
  };
  add(o.soils, drawn::Role::soil);
  add(o.water, drawn::Role::water);
  add(o.probes, drawn::Role::probe);
  add(o.roller, drawn::Role::roller);
  add(o.fixed, drawn::Role::fixed);
  add(o.skipped, drawn::Role::nothing);
  options.snap = read_length("--snap", o.snap);
  options.names = told_regions(o);
  return options;
}

/// The program that reads drawings lies in ../libexec/porosph of this one.
fs::path reader() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  return program.parent_path().parent_path() / "libexec/porosph/read_drawing";
}

void tell(const drawn::Ground& ground, const drawn::Drawing& drawing, const std::string& unit) {
  say(stdout, fmt::format("{} shapes in {}\n", drawing.shapes.size(), unit));
  for (const SoilCase& soil : ground.soils)
    say(stdout, fmt::format("soil    {}, {} corners{}\n", soil.name, soil.polygon.size(),
                            soil.holes.empty() ? "" : fmt::format(", {} holes", soil.holes.size())));
  for (const drawn::WaterLine& line : ground.water)
    say(stdout, fmt::format("water   at {:g} m from {:g} to {:g} m\n", line.level, line.x_from, line.x_to));
  for (const drawn::EndLevel& end : ground.end_levels)
    say(stdout, fmt::format("water   at {:g} m at the {} end\n", end.level, end.is_left ? "left" : "right"));
  say(stdout, ground.supports.empty() ? "support fixed base and rollers at both ends, as none is drawn\n"
                                      : fmt::format("support {} as drawn\n", ground.supports.size()));
  for (const ProbeCase& probe : ground.probes)
    say(stdout, fmt::format("probe   {} at {} m\n", probe.name, place_text(probe.position)));
  for (const std::string& note : ground.notes) say(stdout, "note: " + printable(note) + "\n");
}

}  // namespace

int import_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  const fs::path file =
      o->out.empty() ? fs::path(o->drawing).filename().replace_extension(".toml") : fs::path(o->out);
  if (file.extension() != ".toml")
    throw UsageError(fmt::format("'{}': the name of a case must end in .toml", file.string()));
  if (fs::exists(file) && !o->force)
    throw UsageError(fmt::format("'{}' is there already; --force replaces it", file.string()));
  drawn::Options options = roles_of(*o);
  try {
    const drawn::Drawing drawing = drawn::read_drawing(o->drawing, reader());
    const std::string unit = !o->unit.empty() ? o->unit : drawing.unit.empty() ? "m" : drawing.unit;
    options.metres = metres_of(unit);
    options.reader = reader();
    const drawn::Ground ground = drawn::ground_of(drawing, options);
    const double spacing =
        o->spacing.empty() ? drawn::usual_spacing(ground) : read_length("--spacing", o->spacing);
    tell(ground, drawing, unit);
    const std::string text = drawn::case_of_ground(ground, spacing, fs::path(o->drawing).stem().string(),
                                                   fs::path(o->drawing).filename().string());
    write_file(file, text);
  } catch (const drawn::DrawingError& error) {
    const std::string what = error.what();
    throw UsageError(printable(what.starts_with(o->drawing) ? what : o->drawing + ": " + what));
  }
  read_case(file);
  say(stdout, fmt::format("{}: fill in the lines marked FILL IN, then\n  porosph check {}\n", file.string(),
                          file.string()));
  return Exit::done;
}

}  // namespace porosph::app
