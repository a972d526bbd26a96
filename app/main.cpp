// porosph: one program, one subcommand per job.
#include <fmt/format.h>

#include <csignal>
#include <iostream>

#include "app/command.hpp"
#include "solver/case/case_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace {

using namespace porosph::app;

const std::vector<Command> commands = {
    {"run", "compute a case", run_command},
    {"check", "validate a case and say what it will cost", check_command},
    {"stability", "map where settings keep a case accurate and stable", stability_command},
#ifdef POROSPH_HAS_VTK
    {"fem", "compute the finite-element reference of a case", fem_command},
    {"render", "draw a picture of a series", render_command},
    {"compare", "put two runs side by side, with their difference", compare_command},
    {"report", "make a page of pictures and tables of runs", report_command},
    {"bench", "measure speed, and run time against error", bench_command},
#endif
};

void print_overview(std::ostream& out) {
  out << "Porosph " << POROSPH_VERSION << ": water-saturated soil with smoothed particle hydrodynamics\n\n"
      << "Usage: porosph SUBCOMMAND ...\n\n";
  for (const Command& c : commands) out << fmt::format("  {:10} {}\n", c.name, c.summary);
  out << "\n  porosph SUBCOMMAND --help    options and examples\n  porosph --version\n\n"
      << "Begin with: porosph run cases/foundation.toml\n";
}

int dispatch(const Arguments& arguments) {
  if (arguments.empty()) {
    print_overview(std::cerr);
    return Exit::wrong_input;
  }
  if (arguments[0] == "--help" || arguments[0] == "-h") {
    print_overview(std::cout);
    return Exit::done;
  }
  if (arguments[0] == "--version") {
    std::cout << "porosph " << POROSPH_VERSION << '\n';
    return Exit::done;
  }
  for (const Command& c : commands)
    if (c.name == arguments[0]) return c.run(Arguments(arguments.begin() + 1, arguments.end()));
  throw UsageError(fmt::format("'{}' is no subcommand; porosph --help lists them", arguments[0]));
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that must not grow further is an error like a full disk
  try {
    return dispatch(Arguments(argv + 1, argv + argc));
  } catch (const porosph::CaseError& error) {
    std::cerr << error.what() << '\n';
    return Exit::wrong_input;
  } catch (const porosph::WriteError& error) {
    std::cerr << "porosph: " << error.what() << '\n';
    return Exit::file_failure;
  } catch (const porosph::ReadError& error) {
    std::cerr << "porosph: " << error.what() << '\n';
    return Exit::file_failure;
  } catch (const std::bad_alloc&) {
    std::cerr << "porosph: not enough memory for this case\n";
    return Exit::wrong_input;
  } catch (const std::exception& error) {  // a command line or a case that cannot be computed
    std::cerr << "porosph: " << error.what() << '\n';
    return Exit::wrong_input;
  }
}
