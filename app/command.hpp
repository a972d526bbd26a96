// What a subcommand is.
#pragma once

#include <boost/program_options.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace porosph::app {

using Arguments = std::vector<std::string>;

/// Exit statuses that other programs rely on.
enum Exit : int {
  done = 0,
  failed_threshold = 1,
  wrong_input = 2,
  unstable = 3,
  file_failure = 4,
  interrupted = 130
};
inline constexpr Exit exits[] = {done, failed_threshold, wrong_input, unstable, file_failure, interrupted};
/// What a status says, in a few words.
const char* meaning_of(Exit status);

struct Command {
  std::string name, summary;
  int (*run)(const Arguments&);
};

/// All of them, in the order of the overview.
const std::vector<Command>& all_commands();

/// What --help tells of a subcommand.
struct OptionHelp {
  std::string name;     ///< without dashes
  std::string value;    ///< what follows it, "DIR"; empty for a switch
  std::string meaning;  ///< one sentence
};
struct CommandHelp {
  std::string usage;  ///< "run CASE.toml [options]"
  std::string examples;
  std::vector<OptionHelp> options;
};
CommandHelp help_of(const Command& command);

/// The command line is wrong: exit 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Parses the arguments of a subcommand, which does so before all else. Prints its help and returns false if
/// that was asked for.
/// `usage` is what stands after "porosph", `examples` are complete command lines. Throws UsageError.
bool parse(const Arguments& arguments, const boost::program_options::options_description& options,
           const boost::program_options::positional_options_description& positional, const std::string& usage,
           const std::string& examples, boost::program_options::variables_map& values);

/// The command line as a shell would have to be given it.
std::string command_line(const std::string& subcommand, const Arguments& arguments);

int run_command(const Arguments& arguments);
int check_command(const Arguments& arguments);
int render_command(const Arguments& arguments);
int section_command(const Arguments& arguments);
int grid_command(const Arguments& arguments);
int history_command(const Arguments& arguments);
int schema_command(const Arguments& arguments);
int compare_command(const Arguments& arguments);
int report_command(const Arguments& arguments);
int fem_command(const Arguments& arguments);
int safety_command(const Arguments& arguments);
int element_command(const Arguments& arguments);
int profile_command(const Arguments& arguments);
int stability_command(const Arguments& arguments);
int bench_command(const Arguments& arguments);
int init_command(const Arguments& arguments);
int import_command(const Arguments& arguments);
int list_command(const Arguments& arguments);
int completion_command(const Arguments& arguments);
int man_command(const Arguments& arguments);

}  // namespace porosph::app
