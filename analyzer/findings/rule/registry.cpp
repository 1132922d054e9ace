// Looking up a rule by its name.
#include "findings/rule/registry.h"

#include <algorithm>

namespace feedhold {

const RegisteredRule *findRule(const RuleRegistry &registry, std::string_view name) {
  const auto found = std::find_if(registry.rules.begin(), registry.rules.end(),
                                  [&](const RegisteredRule &entry) { return hasName(entry.rule->info, name); });
  return found == registry.rules.end() ? nullptr : &*found;
}

} // namespace feedhold
