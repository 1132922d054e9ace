// `feedhold self-check`: whether this program does on this machine what it should.
#include "dialects/registry.h"
#include "rules/registry.h"
#include "surface/cli/commands.h"
#include "surface/cli/self_check.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace feedhold {

namespace {

std::string selfCheckText(const std::vector<SelfCheckStep> &steps) {
  std::vector<std::string_view> dialects;
  for (const Dialect *dialect : allDialects().dialects)
    dialects.push_back(dialect->id);
  std::string text = fmt::format("feedhold {}\ndialects: {}\n", FEEDHOLD_VERSION, fmt::join(dialects, ", "));
  for (const SelfCheckStep &step : steps)
    text += fmt::format("{:<8} {:<12} {}\n", step.result(), step.name, step.message());
  return text +
         (passed(steps) ? "the self-check passed\n" : "the self-check failed: do not rely on this installation\n");
}

std::string selfCheckJson(const std::vector<SelfCheckStep> &steps) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const SelfCheckStep &step : steps)
    rows.push_back({{"name", step.name}, {"result", step.result()}, {"message", step.message()}});
  nlohmann::ordered_json dialects = nlohmann::ordered_json::array();
  for (const Dialect *dialect : allDialects().dialects)
    dialects.push_back(dialect->id);
  const nlohmann::ordered_json document = {{"version", 1},
                                           {"feedhold", FEEDHOLD_VERSION},
                                           {"dialects", std::move(dialects)},
                                           {"rules", allRules().rules.size()},
                                           {"steps", std::move(rows)},
                                           {"passed", passed(steps)}};
  return document.dump(2) + "\n";
}

} // namespace

Command addSelfCheckCommand(CLI::App &parent) {
  CLI::App *app =
      parent.add_subcommand("self-check", "run built-in programs with known answers through this installation");
  const auto format = std::make_shared<std::string>("text");
  addFormat(*app, *format, {"text", "json"});
  return {app, [format] {
            const std::vector<SelfCheckStep> steps = selfCheck();
            print(*format == "json" ? selfCheckJson(steps) : selfCheckText(steps));
            return passed(steps) ? kExitClean : kExitFindings;
          }};
}

} // namespace feedhold
