// porosph man: the manual page, from what the subcommands say of themselves.
#include <fmt/format.h>

#include <boost/algorithm/string/replace.hpp>

#include "app/command.hpp"

namespace porosph::app {
namespace {

namespace po = boost::program_options;

std::string escaped(std::string text) {
  boost::replace_all(text, "\\", "\\e");
  boost::replace_all(text, "-", "\\-");
  boost::replace_all(text, "'", "\\(aq");
  if (!text.empty() && text[0] == '.') text = "\\&" + text;
  return text;
}

/// Lines as they are, each with "\&" before it, as a line may begin with a dot.
std::string verbatim(const std::string& text) {
  std::string out = ".nf\n\\&" + escaped(text);
  if (out.back() == '\n') out.pop_back();
  boost::replace_all(out, "\n  ", "\n\\&  ");
  return out + "\n.fi\n";
}

std::string section_of(const Command& command) {
  const CommandHelp help = help_of(command);
  std::string text = fmt::format(".SS porosph {}\n{}.\n", escaped(help.usage), escaped(command.summary));
  for (const OptionHelp& o : help.options)
    text += fmt::format(".TP\n.B \\-\\-{}{}\n{}\n", escaped(o.name),
                        o.value.empty() ? "" : " \\fI" + escaped(o.value) + "\\fR", escaped(o.meaning));
  return text + ".PP\nExamples:\n" + verbatim(help.examples);
}

struct Entry {
  std::string name, meaning;
};

// A test holds both lists against what a run writes and what the sources read.
const std::vector<Entry> files = {
    {"particles.pvd, frames/", "the particles of a run over time, for ParaView"},
    {"open_in_paraview.py, compare_in_paraview.py", "show a run there, or two of them side by side"},
    {"history.csv", "probes over time"},
    {"summary.json", "how the run ended, its speed, memory, final values and errors"},
    {"case.toml", "the case as run, with all defaults and overrides"},
    {"checkpoint.bin", "the state from which the run can be resumed"}};
const std::vector<Entry> environment = {
    {"NO_COLOR", "if set and not empty, no colours are printed; without it they are on a terminal only"},
    {"TERM", "no colours are printed where it is dumb"},
    {"POROSPH_FONT", "a TrueType file for the text in pictures"},
    {"POROSPH_VECTOR_UNITS", "portable, avx2 or avx512: the vector units to compute with, for comparison"},
    {"SOURCE_DATE_EPOCH", "seconds since 1970 that reports name as the time of their making"}};

std::string list_of(const std::vector<Entry>& entries, char font) {
  std::string text;
  for (const Entry& e : entries)
    text += fmt::format(".TP\n.{} {}\n{}\n", font, escaped(e.name), escaped(e.meaning));
  return text;
}

std::string tail() {
  std::vector<Entry> statuses;
  for (const Exit status : exits)
    statuses.push_back({fmt::format("{}", static_cast<int>(status)), meaning_of(status)});
  return ".SH FILES\n" + list_of(files, 'I') + ".SH ENVIRONMENT\n" + list_of(environment, 'B') +
         ".SH EXIT STATUS\n" + list_of(statuses, 'B');
}

}  // namespace

int man_command(const Arguments& arguments) {
  po::variables_map values;
  if (!parse(arguments, po::options_description(), {}, "man", "  porosph man | man -l -\n", values))
    return Exit::done;
  fmt::print(
      ".TH POROSPH 1 \"\" \"Porosph {}\" \"User Commands\"\n.SH NAME\n"
      "porosph \\- water\\-saturated soil with smoothed particle hydrodynamics\n"
      ".SH SYNOPSIS\n.B porosph\n.I SUBCOMMAND\n.RI [ options ]\n.br\n.B porosph \\-\\-help\n.br\n"
      ".B porosph \\-\\-version\n"
      ".SH DESCRIPTION\nPorosph computes submerged foundations, embankments and slopes in plane strain, "
      "writes "
      "particle series that open in ParaView, and draws pictures and reports without a display. A case is a "
      "TOML file; all numbers are in SI units, stress is positive in tension.\n.SH SUBCOMMANDS\n",
      POROSPH_VERSION);
  for (const Command& command : all_commands()) fmt::print("{}", section_of(command));
  fmt::print("{}", tail());
  return Exit::done;
}

}  // namespace porosph::app
