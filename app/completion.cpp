// porosph completion: what a shell offers at the Tab key, from what the subcommands say of themselves.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boost/algorithm/string.hpp>
#include <map>

#include "app/command.hpp"
#include "app/shipped_cases.hpp"
#include "solver/case/case_keys.hpp"
#include "solver/particles/field_table.hpp"

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
  for (const Field& field : field_table()) {
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

/// Of what stands by itself after the subcommand: the second word of its usage.
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

// ---------------------------------------------------------------- bash

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

constexpr const char* bash_head = R"sh(# Completion of porosph for bash: source <(porosph completion bash)
_porosph_words() {  # candidates that begin with the word at the cursor, which may hold = and :
  local cut=${word%"${word##*[:=]}"} candidate
  for candidate in $1; do
    [[ $candidate == "$word"* ]] && COMPREPLY+=("${candidate#"$cut"}")
  done
  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]]; then compopt -o nospace; fi
}
_porosph_paths() {
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(compgen "$1" -- "${word##*=}")
}
_porosph_cases() {  # cases and folders here, and the shipped cases, whose folders are stepped into too
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(compgen -f -X '!*.toml' -- "$word"; compgen -d -- "$word")
  local name rest last=
  for name in $(porosph list --names 2> /dev/null); do
    [[ $name == "$word"* ]] || continue
    rest=${name#"$word"}
    if [[ $rest == */* ]]; then
      name=$word${rest%%/*}/
      compopt -o nospace
    fi
    [[ $name == "$last" ]] || COMPREPLY+=("$name")
    last=$name
  done
}
_porosph() {
  local words line=${COMP_LINE:0:COMP_POINT}
  read -ra words <<< "$line"
  [[ $line == *[[:space:]] ]] && words+=("")
  local word=${words[-1]} previous=${words[-2]}
  COMPREPLY=()
  if [[ ${#words[@]} -eq 2 ]]; then
    _porosph_words '@commands@ --help --version'
    return
  fi
  if [[ $word == --*=* ]]; then
    previous=${word%%=*}
    word=${word#*=}
  fi
  case ${words[1]} in
)sh";

constexpr const char* bash_tail = R"(  esac
}
complete -F _porosph porosph
)";

std::string bash() {
  std::string text = bash_head;
  boost::replace_all(text, "@commands@", fmt::format("{}", fmt::join(names_of_commands(), " ")));
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
  return text + bash_tail;
}

// ---------------------------------------------------------------- zsh

/// Within '...' of an _arguments specification.
std::string zsh_text(std::string text) {
  boost::replace_all(text, "'", "'\\''");
  for (const char* special : {"[", "]", ":"}) boost::replace_all(text, special, std::string("\\") + special);
  return text;
}

std::string zsh_action(const Choices& c) {
  switch (c.kind) {
    case Choices::none:
      return " ";
    case Choices::files:
      return "_files";
    case Choices::folders:
      return "_files -/";
    case Choices::cases:
      return "_porosph_cases";
    case Choices::words: {
      std::string list = boost::join(c.list, " ");
      boost::replace_all(list, ":", "\\:");
      return " _porosph_words " + list;
    }
  }
  return " ";
}

std::string zsh() {
  std::string text =
      "#compdef porosph\n# Completion of porosph for zsh: source <(porosph completion zsh) after compinit, "
      "or\n"
      "# porosph completion zsh > FOLDER_OF_FPATH/_porosph before\n"
      "_porosph_cases() {\n  _files -g '*.toml'\n  compadd -- ${(f)\"$(porosph list --names 2> "
      "/dev/null)\"}\n}\n"
      "_porosph_words() {  # after key= a value goes on without a space\n"
      "  compadd -S '' -- ${(M)@:#*=}\n  compadd -- ${@:#*=}\n}\n"
      "_porosph() {\n  if (( CURRENT == 2 )); then\n    local -a commands=(\n";
  for (const Command& c : all_commands()) text += fmt::format("      '{}:{}'\n", c.name, zsh_text(c.summary));
  text +=
      "    )\n    _describe 'subcommand' commands\n    return\n  fi\n  local name=$words[2]\n"
      "  shift words; (( CURRENT-- ))\n  case $name in\n";
  for (const Command& command : all_commands()) {
    const CommandHelp help = help_of(command);
    text += fmt::format("    {})\n      _arguments '--help[options and examples]'", command.name);
    for (const OptionHelp& o : help.options) {
      const std::string value =
          o.value.empty() ? "" : fmt::format(":{}:{}", zsh_text(o.value), zsh_action(choices_of(o.value)));
      text += fmt::format(" \\\n        '*--{}{}[{}]{}'", o.name, o.value.empty() ? "" : "=",
                          zsh_text(o.meaning), value);
    }
    const Choices positional = positional_of(help);
    if (positional.kind != Choices::none)
      text += fmt::format(" \\\n        '*:argument:{}'", zsh_action(positional));
    text += " ;;\n";
  }
  return text +
         "  esac\n}\n"
         "if [[ $funcstack[1] == _porosph ]]; then _porosph \"$@\"; else compdef _porosph porosph; fi\n";
}

// ---------------------------------------------------------------- fish

std::string fish_text(std::string text) {
  boost::replace_all(text, "\\", "\\\\");
  boost::replace_all(text, "'", "\\'");
  return "'" + text + "'";
}

std::string fish_action(const Choices& c) {
  switch (c.kind) {
    case Choices::none:
      return " -x";
    case Choices::files:
      return " -r -F";
    case Choices::folders:
      return " -x -a '(__fish_complete_directories)'";
    case Choices::cases:
      return " -F -a '(porosph list --names 2> /dev/null)'";
    case Choices::words:
      return fmt::format(" -x -a '{}'", fmt::join(c.list, " "));
  }
  return "";
}

std::string fish() {
  std::string text =
      "# Completion of porosph for fish: porosph completion fish | source\ncomplete -c porosph -f\n"
      "complete -c porosph -n __fish_use_subcommand -l help\n"
      "complete -c porosph -n __fish_use_subcommand -l version\n";
  for (const Command& command : all_commands()) {
    const CommandHelp help = help_of(command);
    text += fmt::format("complete -c porosph -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        fish_text(command.summary));
    const std::string within =
        fmt::format("complete -c porosph -n '__fish_seen_subcommand_from {}'", command.name);
    text += within + " -l help\n";
    for (const OptionHelp& o : help.options)
      text += fmt::format("{} -l {}{} -d {}\n", within, o.name,
                          o.value.empty() ? "" : fish_action(choices_of(o.value)), fish_text(o.meaning));
    if (const Choices c = positional_of(help); c.kind != Choices::none)
      text += within + (c.kind == Choices::files ? " -F" : fish_action(c)) + "\n";
  }
  return text;
}

const std::map<std::string, std::string (*)()> shells = {{"bash", bash}, {"fish", fish}, {"zsh", zsh}};

}  // namespace

int completion_command(const Arguments& arguments) {
  std::string shell;
  po::options_description options;
  options.add_options()("shell", po::value(&shell)->required(), "bash, fish or zsh");
  po::positional_options_description positional;
  positional.add("shell", 1);
  po::variables_map values;
  if (!parse(arguments, options, positional, "completion bash|fish|zsh",
             "  source <(porosph completion bash)\n  source <(porosph completion zsh)\n"
             "  porosph completion fish | source\n",
             values))
    return Exit::done;
  const auto found = shells.find(shell);
  if (found == shells.end()) throw UsageError(fmt::format("'{}': must be bash, fish or zsh", shell));
  fmt::print("{}", found->second());
  return Exit::done;
}

}  // namespace porosph::app
