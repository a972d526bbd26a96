// porosph: one program, one subcommand per job.
#include <fmt/format.h>

#include <csignal>
#include <iostream>

#include "app/colour.hpp"
#include "app/command.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/nearest.hpp"
#include "solver/printable.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace {

using namespace porosph::app;

const std::vector<Command> commands = {
    {"init", "write a case to start from", init_command},
    {"import", "make a case of a drawing", import_command},
    {"list", "name the cases that come with the program", list_command},
    {"run", "compute a case", run_command},
    {"check", "validate a case and say what it will cost", check_command},
    {"safety", "find the factor of safety of a case", safety_command},
    {"element", "test the soils of a case as a laboratory does", element_command},
    {"stability", "map where settings keep a case accurate and stable", stability_command},
#ifdef POROSPH_HAS_VTK
    {"fem", "compute the finite-element reference of a case", fem_command},
#endif
#ifdef POROSPH_HAS_RENDER
    {"render", "draw a picture of a series", render_command},
    {"section", "draw values along a line through the soil", section_command},
    {"grid", "write values of a run on a regular grid", grid_command},
    {"history", "draw what probes recorded: stress, settlement, stress paths", history_command},
    {"profile", "draw the surface of soil that has moved, and how far it went", profile_command},
    {"compare", "put two runs side by side, with their difference", compare_command},
    {"report", "make a page of pictures and tables of runs", report_command},
    {"bench", "measure speed, and run time against error", bench_command},
#endif
    {"schema", "print the JSON schema of cases, for editors", schema_command},
    {"completion", "print what a shell needs to complete command lines", completion_command},
    {"man", "print the manual page", man_command},
};

void print_overview(std::FILE* stream) {
  const auto heading = [&](std::string_view text) { return styled(stream, Style::heading, text); };
  fmt::print(stream, "Porosph {}: water-saturated soil with smoothed particle hydrodynamics\n\n",
             POROSPH_VERSION);
  fmt::print(stream, "{} porosph SUBCOMMAND ...\n\n", heading("Usage:"));
  for (const Command& c : commands) fmt::print(stream, "  {:12} {}\n", c.name, c.summary);
  fmt::print(stream, "\n  porosph SUBCOMMAND --help    options and examples\n  porosph --version\n");
  fmt::print(stream,
             "\n{}\n"
             "  porosph init my_slope.toml                           a slope, every setting explained\n"
             "  porosph run my_slope.toml                            computes it into results/my_slope\n",
             heading("Begin with"));
#ifdef POROSPH_HAS_RENDER
  fmt::print(stream, "  porosph render results/my_slope --field TotalStress:YY   draws a picture\n");
#endif
}

[[noreturn]] void refuse(const std::string& name) {
  std::vector<std::string> names;
  for (const Command& c : commands) names.push_back(c.name);
  const std::string meant = porosph::nearest(name, names);
  throw UsageError(fmt::format("'{}' is not a subcommand{}; porosph --help lists them all", name,
                               meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant)));
}

int dispatch(const Arguments& arguments) {
  if (arguments.empty()) {
    print_overview(stderr);
    return Exit::wrong_input;
  }
  if (arguments[0] == "--help" || arguments[0] == "-h") {
    print_overview(stdout);
    return Exit::done;
  }
  if (arguments[0] == "--version") {
    std::cout << "porosph " << POROSPH_VERSION << '\n';
    return Exit::done;
  }
  for (const Command& c : commands)
    if (c.name == arguments[0]) return c.run(Arguments(arguments.begin() + 1, arguments.end()));
  refuse(arguments[0]);
}

void tell_error(const std::string& message) {
  std::cerr << styled(stderr, Style::error, "porosph:") << ' ' << porosph::printable_lines(message) << '\n';
}

}  // namespace

const std::vector<Command>& porosph::app::all_commands() { return commands; }

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that must not grow further is an error like a full disk
  try {
    return dispatch(Arguments(argv + 1, argv + argc));
  } catch (const porosph::CaseError& error) {
    std::cerr << porosph::printable_lines(error.what()) << '\n';
    return Exit::wrong_input;
  } catch (const porosph::WriteError& error) {
    tell_error(error.what());
    return Exit::file_failure;
  } catch (const porosph::ReadError& error) {
    tell_error(error.what());
    return Exit::file_failure;
  } catch (const std::bad_alloc&) {
    tell_error("not enough memory for this case");
    return Exit::wrong_input;
  } catch (const std::exception& error) {  // a command line or a case that cannot be computed
    tell_error(error.what());
    return Exit::wrong_input;
  }
}
