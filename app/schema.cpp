// porosph schema: the JSON schema of case files.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/case_schema.hpp"
#include "app/command.hpp"

namespace porosph::app {

int schema_command(const Arguments& arguments) {
  boost::program_options::options_description options;
  boost::program_options::variables_map values;
  if (!parse(arguments, options, {}, "schema", "  porosph schema > case.schema.json\n", values))
    return Exit::done;
  fmt::print("{}\n", case_schema().dump(2));
  return Exit::done;
}

}  // namespace porosph::app
