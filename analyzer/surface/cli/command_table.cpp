#include "surface/cli/command_table.h"

#include "dialects/registry.h"
#include "rules/registry.h"

namespace feedhold {

namespace {

/// CLI11 keeps the members of a set only as text: `TEXT:{json,text}`.
std::vector<std::string> membersIn(const std::string &typeName) {
  const std::size_t open = typeName.find('{');
  const std::size_t close = typeName.find('}', open);
  if (close == std::string::npos)
    return {};
  return CLI::detail::split(typeName.substr(open + 1, close - open - 1), ',');
}

/// Sets that are too large for the help: rules and dialects are looked up when the command runs.
std::vector<std::string> lookedUp(const std::string &name) {
  std::vector<std::string> names;
  if (name == "--dialect")
    for (const Dialect *dialect : allDialects().dialects)
      names.emplace_back(dialect->id);
  if (name == "--select" || name == "--ignore" || name == "rule")
    for (const RegisteredRule &entry : allRules().rules)
      names.emplace_back(entry.rule->info.name);
  return names;
}

OptionRow rowOf(const CLI::Option &option) {
  OptionRow row{{}, option.get_description(), option.get_items_expected_max() > 0, membersIn(option.get_type_name())};
  if (option.get_positional()) {
    row.names = {option.get_name(true)};
  } else {
    for (const std::string &name : option.get_snames())
      row.names.push_back("-" + name);
    for (const std::string &name : option.get_lnames())
      row.names.push_back("--" + name);
  }
  if (row.choices.empty() && row.takesValue)
    row.choices = lookedUp(row.names.back());
  return row;
}

CommandRow rowOf(const CLI::App &app) {
  CommandRow row{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option *option : app.get_options())
    (option->get_positional() ? row.positionals : row.options).push_back(rowOf(*option));
  return row;
}

} // namespace

CommandTable commandTable(CLI::App &app) {
  CommandTable table{rowOf(app), {}};
  for (const CLI::App *command : app.get_subcommands({}))
    table.commands.push_back(rowOf(*command));
  return table;
}

} // namespace feedhold
