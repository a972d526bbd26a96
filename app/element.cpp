// porosph element: laboratory tests of the soils of a case.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/command.hpp"
#include "app/numbers.hpp"
#include "app/say.hpp"
#include "app/shipped_cases.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/nearest.hpp"
#include "solver/element/key_numbers.hpp"
#include "solver/model/soil_law.hpp"
#include "solver/printable.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/element_csv.hpp"
#ifdef POROSPH_HAS_RENDER
#include "app/picture_options.hpp"
#include "render/run/element_charts.hpp"
#endif

namespace porosph::app {

#ifdef POROSPH_HAS_RENDER
using namespace render;
#endif

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> words, overrides, pressures, strains, stresses;
  std::string test, k0, place, out;
  int steps = 1000, cycles = 0;
  bool quiet = false;

  const std::string& case_file() const { return words.front(); }
};

std::optional<Options> read_options(const Arguments& arguments) {
  Options o;
  po::options_description options;
  options.add_options()("words", po::value(&o.words)->required(),
                        "the case file, then names of its soils (default: all)")(
      "test",
      po::value(&o.test)
          ->value_name(fmt::format("{}", fmt::join(element_test_names(), "|")))
          ->default_value("triaxial-drained"),
      "which test; extension- is triaxial with the axis lengthened")(
      "pressure", po::value(&o.pressures)->value_name("PA"),
      "effective stress at the start, compression positive, radial if --k0 is not 1; may be given again, for "
      "a "
      "specimen each (default: 1e5)")("k0", po::value(&o.k0)->value_name("K"),
                                      "radial over axial effective stress at the start (default: 1)")(
      "strain", po::value(&o.strains)->value_name("E"),
      "strain to reach: of the volume in isotropic, gamma in simple-shear, else of the axis; may be given "
      "again, to "
      "unload to a smaller one (default: 0.1)")(
      "stress", po::value(&o.stresses)->value_name("PA"),
      "axial effective stress to reach in place of a strain, in isotropic and oedometer; may be given again")(
      "cycles", po::value(&o.cycles)->value_name("N"),
      "in simple-shear: goes to the one --strain and to its opposite so many times")(
      "steps", po::value(&o.steps)->value_name("N")->default_value(1000), "steps to each strain or stress")(
      "at", po::value(&o.place)->value_name("X,Y"),
      "where the specimens are from [m], for strength that grows with depth (default: the soil's highest "
      "point)")("set", po::value(&o.overrides)->value_name("KEY=VALUE"),
                "replaces a setting of the case; may be given again")(
      "out", po::value(&o.out)->value_name("FILE.png"),
      "the charts: .png, .svg or .pdf; the table goes beside them as FILE.csv (default: "
      "results/<case>_<test>.png)")("quiet", "say nothing unless something is wrong");
  po::positional_options_description positional;
  positional.add("words", -1);
  po::variables_map values;
  if (!parse(
          arguments, options, positional, "element CASE.toml [SOIL...] [options]",
          "  porosph element safety/griffiths_lane_1 --pressure 5e4 --pressure 1e5 --pressure 2e5\n"
          "  porosph element safety/griffiths_lane_1 slope --test oedometer --stress 4e5 --stress 1e5\n"
          "  porosph element safety/undrained_slope --test triaxial-undrained --strain 0.05 --out clay.pdf\n"
          "  porosph element failure/liquefaction --test simple-shear-undrained --strain 1e-3 --cycles 10\n",
          values))
    return std::nullopt;
  if (o.steps < 1 || o.steps > 1'000'000)
    throw UsageError(fmt::format("--steps = {}: must be from 1 to 1000000", o.steps));
  if (values.count("cycles") > 0 && (o.cycles < 1 || o.cycles > 10'000))
    throw UsageError(fmt::format("--cycles = {}: must be from 1 to 10000", o.cycles));
  o.quiet = values.count("quiet") > 0;
  return o;
}

ElementTest read_test(const std::string& name) {
  std::vector<std::string> known(element_test_names().begin(), element_test_names().end());
  if (std::ranges::find(known, name) != known.end()) return element_test_of(name);
  const std::string meant = nearest(name, known);
  throw UsageError(fmt::format("--test = {}: must be one of {}{}", printable(name), fmt::join(known, ", "),
                               meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant)));
}

std::vector<const SoilCase*> chosen_soils(const Case& scene, const Options& o) {
  std::vector<const SoilCase*> soils;
  std::vector<std::string> names;
  for (const SoilCase& soil : scene.soils) names.push_back(soil.name);
  for (std::size_t i = 1; i < o.words.size(); ++i) {
    const auto found = std::ranges::find(names, o.words[i]);
    if (found == names.end())
      throw UsageError(fmt::format("element: the case has no soil '{}'; its soils are {}",
                                   printable(o.words[i]), fmt::join(names, ", ")));
    soils.push_back(&scene.soils[static_cast<std::size_t>(found - names.begin())]);
  }
  if (soils.empty())
    for (const SoilCase& soil : scene.soils) soils.push_back(&soil);
  return soils;
}

std::vector<double> numbers(const std::string& option, const std::vector<std::string>& texts, double low,
                            double high, double otherwise) {
  std::vector<double> list;
  for (const std::string& text : texts) {
    const double value = read_number(option, text);
    if (!(value >= low && value <= high))
      throw UsageError(fmt::format("{} = {}: must be from {:g} to {:g}", option, text, low, high));
    list.push_back(value);
  }
  if (list.empty()) list.push_back(otherwise);
  return list;
}

/// Strains to go to, one after the other.
std::vector<double> strains_of(const Options& o, ElementTest test) {
  const std::vector<double> strains = numbers("--strain", o.strains, -2, 2, 0.1);
  if (o.cycles == 0) return strains;
  if (!is_shear(test)) throw UsageError("--cycles: only the simple shear tests go to and fro");
  if (strains.size() > 1) throw UsageError("--cycles: goes to and fro between one --strain and its opposite");
  std::vector<double> cycles;
  for (int i = 0; i < o.cycles; ++i) cycles.insert(cycles.end(), {strains[0], -strains[0]});
  return cycles;
}

Vec2 place_of(const SoilCase& soil, const Options& o) {
  if (o.place.empty())
    return *std::ranges::max_element(soil.polygon, {}, [](const Point& p) { return p.y(); });
  const std::size_t comma = o.place.find(',');
  if (comma == std::string::npos) throw UsageError(fmt::format("--at = {}: must be X,Y", printable(o.place)));
  return {read_number("--at", o.place.substr(0, comma)), read_number("--at", o.place.substr(comma + 1))};
}

std::vector<ElementSetup> read_setups(const Options& o) {
  constexpr double largest = 1e12;
  ElementSetup setup;
  setup.test = read_test(o.test);
  const bool one_way = setup.test == ElementTest::isotropic || setup.test == ElementTest::oedometer;
  const double k0 = o.k0.empty() ? 1 : read_number("--k0", o.k0);
  if (!(k0 > 0 && k0 <= 100)) throw UsageError(fmt::format("--k0 = {}: must be > 0 and <= 100", o.k0));
  if (setup.test == ElementTest::isotropic && k0 != 1)
    throw UsageError("--k0: isotropic compression starts from the same stress all around");
  if (!o.strains.empty() && !o.stresses.empty()) throw UsageError("--strain and --stress: give one of them");
  if (!o.stresses.empty() && !one_way)
    throw UsageError("--stress: only the isotropic and the oedometer test go to a stress; give --strain");
  setup.by_stress = !o.stresses.empty();
  setup.targets =
      setup.by_stress ? numbers("--stress", o.stresses, 0, largest, 0) : strains_of(o, setup.test);
  setup.steps = o.steps;
  std::vector<ElementSetup> setups;
  for (const double pressure : numbers("--pressure", o.pressures, 0, largest, 1e5)) {
    setup.radial_stress = pressure, setup.axial_stress = pressure / k0;
    double from = setup.by_stress ? setup.axial_stress : 0;
    for (const double target : setup.targets) {
      if (target == from)
        throw UsageError(fmt::format("{}: {:g} is where the specimen already is",
                                     setup.by_stress ? "--stress" : "--strain", target));
      from = target;
    }
    setups.push_back(setup);
  }
  return setups;
}

/// Strength softens with the plastic strain of a shear band, so the specimen is one.
AnyLaw law_of_specimen(const SoilCase& soil) {
  const bool softens = soil.law != LawKind::elastic && soil.strength.softening != SofteningKind::none;
  return soil_law(soil, softens ? soil.strength.softening_length : 1);
}

std::vector<ElementRun> run_all(const Case& scene, const Options& o) {
  const std::vector<ElementSetup> setups = read_setups(o);
  std::vector<ElementRun> runs;
  for (const SoilCase* soil : chosen_soils(scene, o))
    for (ElementSetup setup : setups) {
      setup.place = place_of(*soil, o);
      try {
        runs.push_back({soil->name, run_element_test(law_of_specimen(*soil), setup)});
      } catch (const NoEquilibrium& e) {
        throw UsageError(fmt::format("soil '{}': {}", printable(soil->name), e.what()));
      }
    }
  return runs;
}

std::string text_of(const KeyNumber& n) {
  const double size = std::abs(n.value);
  if (n.unit != "Pa") return fmt::format("{:.5g}{}", n.value, n.unit == "-" ? "" : " " + n.unit);
  if (size >= 1e6) return fmt::format("{:.5g} MPa", n.value / 1e6);
  return size >= 1e3 ? fmt::format("{:.5g} kPa", n.value / 1e3) : fmt::format("{:.5g} Pa", n.value);
}

void tell(const std::vector<ElementRun>& runs) {
  for (const ElementRun& run : runs) {
    say(stdout, fmt::format("{}\n", printable(label_of(run, true))));
    for (const KeyNumber& n : key_numbers(run.path))
      say(stdout, fmt::format("  {:44} {}\n", n.name, text_of(n)));
  }
}

/// Of a soil with several specimens; tests that only compress have no peak.
void tell_strength(const std::vector<ElementRun>& runs) {
  const ElementTest test = runs.front().path.setup.test;
  if (test == ElementTest::isotropic || test == ElementTest::oedometer) return;
  for (auto first = runs.begin(); first != runs.end();) {
    const auto last =
        std::find_if(first, runs.end(), [&](const ElementRun& r) { return r.soil != first->soil; });
    std::vector<const ElementPath*> paths;
    for (auto run = first; run != last; ++run) paths.push_back(&run->path);
    if (const auto strength = strength_of_peaks(paths))
      say(stdout,
          fmt::format("{}: line through the peaks: cohesion {:.5g} kPa, friction angle {:.5g} degrees\n",
                      printable(first->soil), strength->cohesion / 1e3, strength->friction_angle));
    first = last;
  }
}

}  // namespace

int element_command(const Arguments& arguments) {
  const auto o = read_options(arguments);
  if (!o) return Exit::done;
  const fs::path out =
      o->out.empty()
          ? fs::path("results") / fmt::format("{}_{}.png", fs::path(o->case_file()).stem().string(), o->test)
          : fs::path(o->out);
#ifdef POROSPH_HAS_RENDER
  require_picture_name(out);
#endif
  const Case scene = read_case(find_case(o->case_file()), o->overrides);
  const std::vector<ElementRun> runs = run_all(scene, *o);
  if (out.has_parent_path()) make_folder(out.parent_path());
  const fs::path table = fs::path(out).replace_extension(".csv");
  write_file(table, element_csv(runs));
#ifdef POROSPH_HAS_RENDER
  const std::string what = runs.size() == 1 ? label_of(runs.front(), true) : runs.front().soil;
  bool one_soil = true;
  for (const ElementRun& run : runs) one_soil = one_soil && run.soil == runs.front().soil;
  save_charts(element_figure(runs, (one_soil ? what + ": " : scene.title + ": ") + o->test), out);
#endif
  if (o->quiet) return Exit::done;
  tell(runs);
  tell_strength(runs);
#ifdef POROSPH_HAS_RENDER
  say(stdout, out.string() + "\n");
#endif
  say(stdout, table.string() + "\n");
  return Exit::done;
}

}  // namespace porosph::app
