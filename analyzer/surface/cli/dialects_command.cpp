// `feedhold dialects`: the controls that can be read for.
#include "dialects/registry.h"
#include "surface/cli/commands.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace feedhold {

namespace {

std::string_view nameOf(MachineKind machine) {
  switch (machine) {
  case MachineKind::Milling: return "milling";
  case MachineKind::Turning: return "turning";
  }
  FEEDHOLD_UNREACHABLE("a machine kind without a name");
}

std::string dialectsAsText() {
  std::size_t width = 0;
  for (const Dialect *dialect : allDialects().dialects)
    width = std::max(width, dialect->id.size());
  std::string text;
  for (const Dialect *dialect : allDialects().dialects)
    text += fmt::format("{:<{}}  {:<8} {} ({})\n", dialect->id, width, nameOf(dialect->machine), dialect->title,
                        dialect->controls);
  return text;
}

std::string dialectsAsJson() {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Dialect *dialect : allDialects().dialects)
    rows.push_back({{"id", dialect->id},
                    {"machine", nameOf(dialect->machine)},
                    {"title", dialect->title},
                    {"controls", dialect->controls}});
  return rows.dump(2) + "\n";
}

} // namespace

Command addDialectsCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("dialects", "list the supported controls (dialects)");
  const auto format = std::make_shared<std::string>("text");
  addFormat(*app, *format, {"text", "json"});
  return {app, [format] {
            print(*format == "json" ? dialectsAsJson() : dialectsAsText());
            return kExitClean;
          }};
}

} // namespace feedhold
