// Applies the steps of a selection rule by rule.
#include "findings/project/selection.h"

#include <algorithm>

namespace feedhold {

namespace {

bool isNamed(const RuleInfo &rule, const std::vector<std::string> &names) {
  return std::any_of(names.begin(), names.end(), [&](const std::string &name) {
    return hasName(rule, name) || name == nameOf(rule.category) || name == kAllRules;
  });
}

bool isSelected(const RuleInfo &rule, const std::vector<SelectionStep> &steps) {
  bool selected = true;
  for (const SelectionStep &step : steps) {
    if (step.names.empty())
      continue;
    switch (step.kind) {
    case SelectionStep::Kind::Select: selected = isNamed(rule, step.names); break;
    case SelectionStep::Kind::Ignore: selected = selected && !isNamed(rule, step.names); break;
    }
  }
  return selected;
}

} // namespace

std::vector<const Rule *> selectRules(const RuleRegistry &registry, const std::vector<SelectionStep> &steps) {
  std::vector<const Rule *> selected;
  for (const RegisteredRule &entry : registry.rules)
    if (isSelected(entry.rule->info, steps))
      selected.push_back(entry.rule);
  return selected;
}

} // namespace feedhold
