// porosph list: the cases that come with the program.
#include <fmt/format.h>

#include <iostream>

#include "app/command.hpp"
#include "app/shipped_cases.hpp"

namespace porosph::app {

namespace po = boost::program_options;

int list_command(const Arguments& arguments) {
  po::options_description options;
  options.add_options()("names", "print the names alone, one a line")("paths",
                                                                      "print the files alone, one a line");
  po::variables_map values;
  if (!parse(arguments, options, {}, "list [options]",
             "  porosph list\n  porosph run foundation\n  cp \"$(porosph list --paths | head -1)\" "
             "my_case.toml\n",
             values))
    return Exit::done;
  const std::vector<ShippedCase> cases = shipped_cases();
  if (cases.empty())
    throw UsageError("no cases lie beside this program; was it installed with its share folder?");
  if (values.count("names") + values.count("paths") > 0) {
    for (const ShippedCase& c : cases)
      fmt::print("{}\n", values.count("names") > 0 ? c.name : c.file.string());
    return Exit::done;
  }
  std::size_t width = 0;
  for (const ShippedCase& c : cases) width = std::max(width, c.name.size());
  for (const ShippedCase& c : cases) fmt::print("{:{}}  {}\n", c.name, width, c.title);
  fmt::print("\nCompute one by its name: porosph run {}\n", cases.front().name);
  return Exit::done;
}

}  // namespace porosph::app
