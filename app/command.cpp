#include "app/command.hpp"

#include <fmt/format.h>

#include <iostream>

namespace porosph::app {

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

}  // namespace

std::string command_line(const std::string& subcommand, const Arguments& arguments) {
  std::string text = "porosph " + subcommand;
  for (const std::string& argument : arguments) text += " " + quoted(argument);
  return text;
}

bool parse(const Arguments& arguments, const po::options_description& options,
           const po::positional_options_description& positional, const std::string& usage,
           const std::string& examples, po::variables_map& values) {
  if (std::find(arguments.begin(), arguments.end(), "--help") != arguments.end() ||
      std::find(arguments.begin(), arguments.end(), "-h") != arguments.end()) {
    po::options_description shown("Options");
    for (const auto& option : options.options())
      if (positional.max_total_count() == 0 || option->long_name() != positional.name_for_position(0))
        shown.add(option);
    std::cout << "Usage: porosph " << usage << "\n\n" << shown << "\nExamples:\n" << examples;
    return false;
  }
  try {
    po::store(po::command_line_parser(arguments)
                  .options(options)
                  .positional(positional)
                  .style(po::command_line_style::default_style & ~po::command_line_style::allow_guessing)
                  .run(),
              values);
    po::notify(values);
  } catch (const po::error& error) {
    throw UsageError(fmt::format("{}; porosph {} --help shows what is allowed", error.what(),
                                 usage.substr(0, usage.find(' '))));
  }
  return true;
}

}  // namespace porosph::app
