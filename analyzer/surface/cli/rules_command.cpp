// `feedhold rules`: the list of all rules.
#include "rules/registry.h"
#include "surface/cli/commands.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace feedhold {

namespace {

std::string rulesAsText() {
  std::size_t width = 0;
  for (const RegisteredRule &entry : allRules().rules)
    width = std::max(width, entry.rule->info.name.size());
  std::string text;
  for (const RegisteredRule &entry : allRules().rules) {
    const RuleInfo &info = entry.rule->info;
    text += fmt::format("{:<{}}  {:<11} {:<8} {}\n", info.name, width, nameOf(info.category), nameOf(info.severity),
                        info.summary);
  }
  return text;
}

std::string rulesAsJson() {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const RegisteredRule &entry : allRules().rules) {
    const RuleInfo &info = entry.rule->info;
    rows.push_back({{"name", info.name},
                    {"category", nameOf(info.category)},
                    {"severity", nameOf(info.severity)},
                    {"summary", info.summary}});
  }
  return rows.dump(2) + "\n";
}

std::string rulesAsMarkdown() {
  std::string text = "| rule | category | severity | summary |\n|---|---|---|---|\n";
  for (const RegisteredRule &entry : allRules().rules) {
    const RuleInfo &info = entry.rule->info;
    text +=
        fmt::format("| `{}` | {} | {} | {} |\n", info.name, nameOf(info.category), nameOf(info.severity), info.summary);
  }
  return text;
}

int listRules(const std::string &format) {
  print(format == "json" ? rulesAsJson() : format == "markdown" ? rulesAsMarkdown() : rulesAsText());
  return kExitClean;
}

} // namespace

Command addRulesCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("rules", "list all rules");
  const auto format = std::make_shared<std::string>("text");
  addFormat(*app, *format, {"text", "json", "markdown"});
  return {app, [format] { return listRules(*format); }};
}

} // namespace feedhold
