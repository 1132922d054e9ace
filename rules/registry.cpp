// Joins the lines of rules.def with the pages, once.
#include "rules/registry.h"

#include "rules/pages.h"

#include <algorithm>
#include <vector>

namespace feedhold {

namespace rules {
#define RULE(symbol, file)                                                                                             \
  namespace file {                                                                                                     \
  extern const Rule symbol;                                                                                            \
  }
#include "rules/rules.def"
#undef RULE
} // namespace rules

namespace {

std::string_view pageOf(std::string_view file) {
  const std::span<const rules::Page> pages(rules::kPages, rules::kPageCount);
  const auto found =
      std::find_if(pages.begin(), pages.end(), [&](const rules::Page &page) { return page.file == file; });
  return found == pages.end() ? std::string_view() : found->text;
}

std::vector<RegisteredRule> collect() {
  std::vector<RegisteredRule> all = {
#define RULE(symbol, file) {&rules::file::symbol, pageOf(#file)},
#include "rules/rules.def"
#undef RULE
  };
  std::sort(all.begin(), all.end(),
            [](const RegisteredRule &a, const RegisteredRule &b) { return a.rule->info.name < b.rule->info.name; });
  return all;
}

} // namespace

const RuleRegistry &allRules() {
  static const std::vector<RegisteredRule> all = collect();
  static const RuleRegistry registry{all};
  return registry;
}

} // namespace feedhold
