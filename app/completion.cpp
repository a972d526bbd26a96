// porosph completion: what a shell offers at the Tab key, from what the subcommands say of themselves.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boost/algorithm/string.hpp>

#include "app/command.hpp"
#include "app/completion_bash.hpp"
#include "app/shipped_cases.hpp"
#include "solver/analysis/derived_fields.hpp"
#include "solver/case/case_keys.hpp"
#include "solver/fields/field_table.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;
using Words = std::vector<std::string>;

/// What may stand for a value.
struct Choices {
  enum Kind { none, files, folders, words, cases } kind = none;
  Words list;
};

Words settings() {
  Words all;
  for (const CaseKey& key : case_keys()) {
    if (key.values.empty()) all.push_back(key.path + "=");
    for (const std::string& value : key.values) all.push_back(key.path + "=" + value);
  }
  return all;
}

Words selections() {
  Words all;
  std::vector<Field> fields = field_table();
  fields.insert(fields.end(), derived_field_table().begin(), derived_field_table().end());
  for (const Field& field : fields) {
    const std::string name(field.name);
    const std::vector<std::string> components = component_names(field.kind);
    if (components.size() < 4) all.push_back(name);
    for (const std::string& component : components) all.push_back(name + ":" + component);
  }
  return all;
}

/// From the name that the help gives to a value, such as DIR, FILE.png, T|last|all.
Choices choices_of(const std::string& value) {
  const std::string name = value.substr(0, value.find_first_of(" ="));
  if (value.starts_with("KEY=")) return {Choices::words, settings()};
  if (value.starts_with("NAME[")) return {Choices::words, selections()};
  if (name.find("CASE") != std::string::npos) return {Choices::cases, {}};
  if (name.find('|') != std::string::npos) {
    Words list;
    boost::split(list, name, boost::is_any_of("|"));
    std::erase_if(list, [](const std::string& word) { return boost::all(word, boost::is_upper()); });
    return {Choices::words, list};
  }
  if (name.find("FILE") != std::string::npos || name.find(".pvd") != std::string::npos)
    return {Choices::files, {}};
  if (name.find("DIR") != std::string::npos || name.find("RUN") != std::string::npos)
    return {Choices::folders, {}};
  return {};
}

/// Reads what stands by itself after the subcommand from the second word of its usage.
Choices positional_of(const CommandHelp& help) {
  Words words;
  boost::split(words, help.usage, boost::is_any_of(" "));
  if (words.size() < 2 || words[1] == "[options]") return {};
  boost::erase_all(words[1], "[");
  boost::erase_all(words[1], "]");
  return choices_of(words[1]);
}

Words names_of_commands() {
  Words names;
  for (const Command& command : all_commands()) names.push_back(command.name);
  return names;
}

std::string bash_action(const Choices& c) {
  switch (c.kind) {
    case Choices::none:
      return ":";
    case Choices::files:
      return "_porosph_paths -f";
    case Choices::folders:
      return "_porosph_paths -d";
    case Choices::cases:
      return "_porosph_cases";
    case Choices::words:
      return fmt::format("_porosph_words '{}'", fmt::join(c.list, " "));
  }
  return ":";
}

std::string bash() {
  std::string text;
  for (const Command& command : all_commands()) {
    const CommandHelp help = help_of(command);
    Words names = {"--help"};
    text += fmt::format("    {})\n      case $previous in\n", command.name);
    for (const OptionHelp& o : help.options) {
      names.push_back("--" + o.name);
      if (!o.value.empty())
        text += fmt::format("        --{}) {}; return ;;\n", o.name, bash_action(choices_of(o.value)));
    }
    text += fmt::format("      esac\n      if [[ $word == -* ]]; then _porosph_words '{}'; else {}; fi ;;\n",
                        fmt::join(names, " "), bash_action(positional_of(help)));
  }
  std::string script = completion_bash;
  boost::replace_all(script, "@commands@", fmt::format("{}", fmt::join(names_of_commands(), " ")));
  boost::replace_all(script, "@subcommands@", text);
  return script;
}

}  // namespace

int completion_command(const Arguments& arguments) {
  std::string shell;
  po::options_description options;
  options.add_options()("shell", po::value(&shell)->required(), "bash");
  po::positional_options_description positional;
  positional.add("shell", 1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "completion bash", "  source <(porosph completion bash)\n",
             values))
    return Exit::done;
  if (shell != "bash") throw UsageError(fmt::format("'{}': must be bash", shell));
  fmt::print("{}", bash());
  return Exit::done;
}

}  // namespace porosph::app
