// The list of all rules, handed in from outside: the engine does not know which exist.
#pragma once

#include "findings/rule/rule.h"

namespace feedhold {

struct RegisteredRule {
  const Rule *rule;
  std::string_view page; // the whole Markdown page: what `explain` prints and what the tests run
};

struct RuleRegistry {
  std::span<const RegisteredRule> rules; // by name
};

const RegisteredRule *findRule(const RuleRegistry &registry, std::string_view name);

} // namespace feedhold
