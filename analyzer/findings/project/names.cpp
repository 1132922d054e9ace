// The names that people write in settings and options: rules, categories, dialects, patterns.
#include "base/support/text.h"
#include "findings/project/config.h"
#include "findings/project/selection.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

bool patternMatches(std::string_view pattern, std::string_view path) {
  if (pattern.ends_with('/'))
    pattern.remove_suffix(1);
  const bool isNameOnly = pattern.find('/') == std::string_view::npos;
  const std::string whole = isNameOnly ? "**/" + std::string(pattern) : std::string(pattern);
  return globMatches(whole, path) || globMatches(whole + "/**", path);
}

std::optional<std::string> complaintAboutRuleName(std::string_view name, const RuleRegistry &rules) {
  if (findRule(rules, name) != nullptr)
    return std::nullopt;
  std::vector<std::string_view> known = {kAllRules};
  for (const RegisteredRule &entry : rules.rules) {
    known.push_back(entry.rule->info.name);
    const std::string_view category = nameOf(entry.rule->info.category);
    if (std::find(known.begin(), known.end(), category) == known.end())
      known.push_back(category);
  }
  if (std::find(known.begin(), known.end(), name) != known.end())
    return std::nullopt;
  if (const auto nearest = nearestWord(name, known))
    return fmt::format("there is no rule or category `{}`; did you mean `{}`?", name, *nearest);
  return fmt::format("there is no rule or category `{}`; `feedhold rules` lists them", name);
}

std::optional<std::string> complaintAboutDialect(std::string_view id, const DialectRegistry &dialects) {
  if (findDialect(dialects, id) != nullptr)
    return std::nullopt;
  std::vector<std::string_view> known;
  for (const Dialect *dialect : dialects.dialects)
    known.push_back(dialect->id);
  if (const auto nearest = nearestWord(id, known))
    return fmt::format("there is no dialect `{}`; did you mean `{}`?", id, *nearest);
  return fmt::format("there is no dialect `{}`; one of: {}", id, fmt::join(known, ", "));
}

} // namespace feedhold
