#include "app/command.hpp"

#include <fmt/format.h>

#include <iostream>

#include "app/colour.hpp"

namespace porosph::app {

const char* meaning_of(Exit status) {
  switch (status) {
    case done:
      return "done";
    case failed_threshold:
      return "a threshold of a report failed";
    case wrong_input:
      return "the command line or the case is wrong";
    case unstable:
      return "the run became unstable; its files up to then are kept";
    case file_failure:
      return "a file could not be read or written";
    case interrupted:
      return "interrupted";
  }
  return "";
}

namespace po = boost::program_options;

namespace {

/// As a shell would have to be given it.
std::string quoted(const std::string& argument) {
  const bool plain = !argument.empty() && argument.find_first_not_of(
                                              "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                              "0123456789_-./,:=+@%") == std::string::npos;
  if (plain) return argument;
  std::string out = "'";
  for (char c : argument) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// Where parse() puts the help of a command in place of printing it; null: it prints.
CommandHelp* wanted_help = nullptr;

bool asks_for_help(const Arguments& arguments) {
  return std::find(arguments.begin(), arguments.end(), "--help") != arguments.end() ||
         std::find(arguments.begin(), arguments.end(), "-h") != arguments.end();
}

bool is_positional(const po::option_description& option, const po::positional_options_description& p) {
  return p.max_total_count() > 0 && option.long_name() == p.name_for_position(0);
}

CommandHelp make_help(const po::options_description& options,
                      const po::positional_options_description& positional, const std::string& usage,
                      const std::string& examples) {
  CommandHelp help{usage, examples, {}};
  for (const auto& option : options.options()) {
    if (is_positional(*option, positional)) continue;
    const bool takes_value = option->semantic()->max_tokens() > 0;
    help.options.push_back(
        {option->long_name(), takes_value ? option->format_parameter() : "", option->description()});
  }
  return help;
}

void print_help(const po::options_description& options, const po::positional_options_description& positional,
                const std::string& usage, const std::string& examples) {
  po::options_description shown;
  for (const auto& option : options.options())
    if (!is_positional(*option, positional)) shown.add(option);
  const auto heading = [](std::string_view text) { return styled(stdout, Style::heading, text); };
  std::cout << heading("Usage:") << " porosph " << usage << "\n\n"
            << heading("Options:") << '\n'
            << shown << '\n'
            << heading("Examples:") << '\n'
            << examples;
}

}  // namespace

std::string command_line(const std::string& subcommand, const Arguments& arguments) {
  std::string text = "porosph " + subcommand;
  for (const std::string& argument : arguments) text += " " + quoted(argument);
  return text;
}

CommandHelp help_of(const Command& command) {
  CommandHelp help;
  wanted_help = &help;
  command.run({"--help"});
  wanted_help = nullptr;
  return help;
}

bool parse(const Arguments& arguments, const po::options_description& options,
           const po::positional_options_description& positional, const std::string& usage,
           const std::string& examples, po::variables_map& values) {
  if (asks_for_help(arguments)) {
    if (wanted_help != nullptr)
      *wanted_help = make_help(options, positional, usage, examples);
    else
      print_help(options, positional, usage, examples);
    return false;
  }
  const std::string name = usage.substr(0, usage.find(' '));
  try {
    po::store(po::command_line_parser(arguments)
                  .options(options)
                  .positional(positional)
                  .style(po::command_line_style::default_style & ~po::command_line_style::allow_guessing)
                  .run(),
              values);
    po::notify(values);
  } catch (const po::required_option& missing) {
    const std::string given = missing.get_option_name();
    const bool is_first = positional.max_total_count() > 0 && given == "--" + positional.name_for_position(0);
    throw UsageError(fmt::format("{} is missing; usage: porosph {}; porosph {} --help shows more",
                                 is_first ? "a " + positional.name_for_position(0) : given, usage, name));
  } catch (const po::error& error) {
    throw UsageError(fmt::format("{}; porosph {} --help shows what is allowed", error.what(), name));
  }
  return true;
}

}  // namespace porosph::app
