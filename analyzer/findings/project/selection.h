// Selection: which rules run, chosen by names of rules and categories.
#pragma once

#include "findings/rule/registry.h"

#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

/// Beside the names of rules and categories.
inline constexpr std::string_view kAllRules = "all";

/// Each step takes its names over what the steps before have chosen.
struct SelectionStep {
  enum class Kind { Select, Ignore }; // Select replaces, Ignore takes out; no names: no change
  Kind kind;
  std::vector<std::string> names;
};

/// Starts from all rules; in order of the registry.
std::vector<const Rule *> selectRules(const RuleRegistry &registry, const std::vector<SelectionStep> &steps);

} // namespace feedhold
