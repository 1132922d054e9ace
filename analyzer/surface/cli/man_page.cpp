#include "surface/cli/man_page.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

/// A backslash begins a command of roff, a hyphen may be printed as a dash, and a point or a quote at the start of a
/// line is a request.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
  return result.starts_with('.') || result.starts_with('\'') ? "\\&" + result : result;
}

std::string valueOf(const OptionRow &option) {
  constexpr std::size_t kMostShown = 10; // rules and dialects have commands that list them
  if (!option.takesValue)
    return {};
  if (option.choices.empty() || option.choices.size() > kMostShown)
    return " \\fIVALUE\\fR";
  std::string text;
  for (const std::string &choice : option.choices)
    text += (text.empty() ? " " : "|") + roff(choice);
  return text;
}

std::string paragraphOf(const OptionRow &option) {
  std::string names;
  for (const std::string &name : option.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
  return fmt::format(".TP\n{}{}\n{}\n", names, valueOf(option), roff(option.description));
}

std::string sectionOf(const CommandRow &command) {
  std::string synopsis = fmt::format("\\fBfeedhold {}\\fR [\\fIOPTIONS\\fR]", roff(command.name));
  for (const OptionRow &positional : command.positionals)
    synopsis += fmt::format(" \\fI{}\\fR", roff(positional.names.front()));
  std::string text = fmt::format(".SS {}\n{}\n.PP\n{}\n", roff(command.name), synopsis, roff(command.description));
  for (const OptionRow &positional : command.positionals)
    text += fmt::format(".TP\n\\fI{}\\fR\n{}\n", roff(positional.names.front()), roff(positional.description));
  for (const OptionRow &option : command.options)
    text += paragraphOf(option);
  return text;
}

constexpr std::string_view kTail = R"(.SH EXIT STATUS
.TP
0
No findings, or everything is proved.
.TP
1
Findings, or something is refuted.
.TP
2
The command could not run: a wrong option, a file that cannot be read, a configuration with errors.
.TP
3
Of \fBprove\fR: nothing is refuted, but not everything is proved.
.TP
4
Of \fBprove\fR: a run contradicts a verdict, which is a defect of Feedhold; please report it.
.SH FILES
.TP
feedhold.toml
The configuration: the nearest one in the folder of a program or above.
.TP
O9100.contract, part.contract
Contracts and suppressions of a program, in a sidecar file beside it.
.SH ENVIRONMENT
.TP
NO_COLOR
When set, the output has no colours.
.TP
XDG_CACHE_HOME
Verdicts are cached in its folder \fIfeedhold\fR.
)";

} // namespace

std::string manPage(const CommandTable &table, std::string_view version) {
  std::string text = fmt::format(
      ".\\\" Made by `feedhold man`.\n.TH FEEDHOLD 1 \"\" \"feedhold {}\" \"User Commands\"\n", roff(version));
  text += ".SH NAME\nfeedhold \\- checks and proves CNC macro programs\n";
  text += ".SH SYNOPSIS\n\\fBfeedhold\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] [\\fIPATHS\\fR]\n";
  text += fmt::format(".SH DESCRIPTION\n{}.\n", roff(table.program.description));
  for (const OptionRow &option : table.program.options)
    text += paragraphOf(option);
  text += ".SH COMMANDS\n";
  for (const CommandRow &command : table.commands)
    text += sectionOf(command);
  return text + std::string(kTail);
}

} // namespace feedhold
