// `feedhold explain RULE`: the page of a rule.
#include "base/support/text.h"
#include "findings/project/config.h"
#include "rules/registry.h"
#include "surface/cli/commands.h"
#include "surface/cli/terminal.h"

#include <fmt/format.h>

#include <memory>

namespace feedhold {

namespace {

int explain(const std::string &asked) {
  const std::string name = toLower(asked);
  if (const RegisteredRule *entry = findRule(allRules(), name)) {
    print(entry->page);
    return kExitClean;
  }
  printError(complaintAboutRuleName(name, allRules())
                 .value_or(fmt::format("`{}` is a category; `feedhold rules` lists its rules", name)));
  return kExitCouldNotRun;
}

} // namespace

Command addExplainCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("explain", "explain a rule, with examples");
  const auto name = std::make_shared<std::string>();
  app->add_option("rule", *name, "name of the rule, such as missing-equals")->type_name("RULE")->required();
  return {app, [name] { return explain(*name); }};
}

} // namespace feedhold
