#include "surface/cli/completions.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace {

/// What stands between single quotes.
std::string inQuotes(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + result + "'";
}

std::vector<std::string> namesOf(const std::vector<OptionRow> &options) {
  std::vector<std::string> names;
  for (const OptionRow &option : options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::vector<std::string> namesOf(const std::vector<CommandRow> &commands) {
  std::vector<std::string> names;
  for (const CommandRow &command : commands)
    names.push_back(command.name);
  return names;
}

bool takesFiles(const CommandRow &command) {
  return !command.positionals.empty() && command.positionals.front().choices.empty();
}

/// `check:--format)`: what may stand behind it; nothing: a file or any text.
std::string bashValues(const CommandRow &command) {
  std::string text;
  for (const OptionRow &option : command.options) {
    if (!option.takesValue)
      continue;
    std::vector<std::string> patterns;
    for (const std::string &name : option.names)
      patterns.push_back(command.name + ":" + name);
    text += fmt::format("    {}) words={} ;;\n", fmt::join(patterns, " | "),
                        inQuotes(fmt::format("{}", fmt::join(option.choices, " "))));
  }
  return text;
}

std::string bashWords(const CommandRow &command) {
  const std::vector<std::string> choices =
      command.positionals.empty() ? std::vector<std::string>() : command.positionals.front().choices;
  return fmt::format("    {}:-*) words={} ;;\n    {}:*) words={} ;;\n", command.name,
                     inQuotes(fmt::format("{}", fmt::join(namesOf(command.options), " "))), command.name,
                     inQuotes(fmt::format("{}", fmt::join(choices, " "))));
}

/// In a word of `_arguments`: brackets and colons end a part.
std::string zshText(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += c == '[' || c == ']' || c == ':' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return result;
}

std::string zshValue(const OptionRow &option) {
  if (!option.takesValue)
    return {};
  return option.choices.empty() ? ":value:_files" : fmt::format(":value:({})", fmt::join(option.choices, " "));
}

std::string zshOption(const OptionRow &option, const std::string &name) {
  const bool isLong = option.takesValue && name.starts_with("--");
  return inQuotes(fmt::format("*{}{}[{}]{}", name, isLong ? "=" : "", zshText(option.description), zshValue(option)));
}

std::string zshArguments(const CommandRow &command) {
  std::string text = "_arguments";
  for (const OptionRow &option : command.options)
    for (const std::string &name : option.names)
      text += " \\\n        " + zshOption(option, name);
  for (const OptionRow &positional : command.positionals)
    text +=
        fmt::format(" \\\n        {}",
                    inQuotes(fmt::format("*:{}{}", zshText(positional.names.front()), zshValue(positional).substr(6))));
  return text;
}

std::string fishOption(const std::string &condition, const OptionRow &option) {
  std::string text = fmt::format("complete -c feedhold -n {}", inQuotes(condition));
  for (const std::string &name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.takesValue)
    text += option.choices.empty()
                ? " -r"
                : fmt::format(" -x -a {}", inQuotes(fmt::format("{}", fmt::join(option.choices, " "))));
  return text + fmt::format(" -d {}\n", inQuotes(option.description));
}

} // namespace

std::string bashCompletions(const CommandTable &table) {
  const std::string commands = fmt::format("{}", fmt::join(namesOf(table.commands), " "));
  std::string values;
  std::string words;
  for (const CommandRow &command : table.commands) {
    values += bashValues(command);
    words += bashWords(command);
  }
  return fmt::format(R"(# Completions of feedhold for bash; made by `feedhold completions bash`.
_feedhold() {{
  local word words='' command='' cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}}
  COMPREPLY=()
  # bash takes `--format=json` apart at the sign
  if [[ $cur == = ]]; then
    cur=''
  elif [[ $prev == = ]]; then
    prev=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case $word in
    {}) command=$word; break ;;
    esac
  done
  if [[ -z $command ]]; then
    COMPREPLY=($(compgen -W {} -- "$cur"))
    return
  fi
  case $command:$prev in
{}    *)
    case $command:$cur in
{}    esac ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$cur"))
}}
complete -o bashdefault -o default -F _feedhold feedhold
)",
                     fmt::join(namesOf(table.commands), " | "),
                     inQuotes(fmt::format("{} {}", commands, fmt::join(namesOf(table.program.options), " "))), values,
                     words);
}

std::string zshCompletions(const CommandTable &table) {
  std::string commands;
  std::string cases;
  for (const CommandRow &command : table.commands) {
    commands += fmt::format("      {}\n", inQuotes(zshText(command.name) + ":" + zshText(command.description)));
    cases += fmt::format("    {})\n      {} ;;\n", command.name, zshArguments(command));
  }
  std::string options;
  for (const OptionRow &option : table.program.options)
    for (const std::string &name : option.names)
      options += zshOption(option, name) + " ";
  return fmt::format(R"(#compdef feedhold
# Completions of feedhold for zsh; made by `feedhold completions zsh`.
_feedhold() {{
  local curcontext=$curcontext state line
  local -a commands
  _arguments -C {}'1: :->command' '*:: :->argument'
  case $state in
  command)
    commands=(
{}    )
    _describe command commands ;;
  argument)
    case $line[1] in
{}    esac ;;
  esac
}}
if [[ $funcstack[1] == _feedhold ]]; then
  _feedhold "$@"
else
  compdef _feedhold feedhold
fi
)",
                     options, commands, cases);
}

std::string fishCompletions(const CommandTable &table) {
  const std::string commands = fmt::format("{}", fmt::join(namesOf(table.commands), " "));
  const std::string none = "not __fish_seen_subcommand_from " + commands;
  std::string text = "# Completions of feedhold for fish; made by `feedhold completions fish`.\n";
  for (const OptionRow &option : table.program.options)
    text += fishOption(none, option);
  for (const CommandRow &command : table.commands) {
    const std::string inside = "__fish_seen_subcommand_from " + command.name;
    text += fmt::format("complete -c feedhold -f -n {} -a {} -d {}\n", inQuotes(none), command.name,
                        inQuotes(command.description));
    for (const OptionRow &option : command.options)
      text += fishOption(inside, option);
    if (!takesFiles(command))
      text += fmt::format("complete -c feedhold -f -n {}\n", inQuotes(inside));
    for (const OptionRow &positional : command.positionals)
      if (!positional.choices.empty())
        text += fmt::format("complete -c feedhold -n {} -a {}\n", inQuotes(inside),
                            inQuotes(fmt::format("{}", fmt::join(positional.choices, " "))));
  }
  return text;
}

} // namespace feedhold
