// porosph init: writes a case to start from.
#include <fmt/format.h>

#include <filesystem>

#include "app/command.hpp"
#include "solver/case/commented_case.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

/// A slope of 5 m, 1 : 2, half of it under water.
constexpr const char* slope = R"(title = "My slope"
[particles]
spacing = 0.25
[[soil]]
name = "sand"
polygon = [[0, 0], [30, 0], [30, 5], [20, 5], [10, 10], [0, 10]]
youngs_modulus = 15e6
poissons_ratio = 0.3
unit_weight_saturated = 20e3
unit_weight_unsaturated = 18e3
[water]
level = 7.5
[[boundary]]
kind = "roller"
from = [0, 0]
to = [0, 12]
[[boundary]]
kind = "roller"
from = [30, 0]
to = [30, 12]
[[boundary]]
kind = "fixed"
from = [0, 0]
to = [30, 0]
[loading]
damping = 0.02
[time]
end = 4
courant = 0.6
[stop]
unbalanced_force_ratio = 1e-4
[output]
interval = 0.1
[[probe]]
name = "A"
position = [10, 4]
[[probe]]
name = "crest"
position = [9.5, 9.5]
)";

}  // namespace

int init_command(const Arguments& arguments) {
  std::string file;
  po::options_description options;
  options.add_options()("case", po::value(&file)->value_name("FILE.toml")->default_value("my_slope.toml"),
                        "the case to write")("force", "replace a file of that name");
  po::positional_options_description positional;
  positional.add("case", 1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "init [CASE.toml] [options]",
             "  porosph init\n  porosph init dam.toml && porosph run dam.toml\n", values))
    return Exit::done;
  if (fs::path(file).extension() != ".toml")
    throw UsageError(fmt::format("'{}': the name of a case must end in .toml", file));
  if (fs::exists(file) && values.count("force") == 0)
    throw UsageError(fmt::format("'{}' is there already; --force replaces it", file));
  write_file(
      file,
      "# A slope under water, to be made your own. Lines that begin with #key show what holds without\n"
      "# them; remove the # to change it. SI units, x to the right, y upwards.\n" +
          commented_case(slope));
  fmt::print("{}: a slope under water, every key explained. Next:\n  porosph check {}\n  porosph run {}\n",
             file, file, file);
  return Exit::done;
}

}  // namespace porosph::app
