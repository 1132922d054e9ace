// parameter-without-meaning: `#5022` in a program for LinuxCNC, where it is no position.
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

#include <set>

namespace feedhold::rules::parameter_without_meaning {
namespace {

constexpr std::uint32_t kLastOfUser = 5000;

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.grammar.oWords)
    return;
  std::set<std::uint32_t> told;
  for (const Read &read : readsOf(facts)) {
    const VariableRange *range =
        read.number && *read.number < kFirstNamedVariable ? findVariable(context.dialect, *read.number) : nullptr;
    if (!range || range->kind != VariableKind::Common || *read.number <= kLastOfUser ||
        isWrittenInAny(facts, *read.number) || !told.insert(*read.number).second)
      continue;
    const Span span = context.tree.expressions[read.expression].span;
    reporter.report({.message = fmt::format("nothing sets {}: the control has no meaning for it", context.quoted(span)),
                     .span = span,
                     .notes = {"it is 0, unless the parameter file of the machine says otherwise",
                               "positions are `#5420` to `#5428`, or `#<_x>`, `#<_y>`, `#<_z>`; the contact of a probe "
                               "is in `#5061` to `#5069`"}});
  }
}

} // namespace

extern const Rule parameterWithoutMeaning;
const Rule parameterWithoutMeaning{.info = {"parameter-without-meaning", Category::Variable, Severity::Warning,
                                            "Reports a parameter above #5000 that neither the control nor a program "
                                            "sets."},
                                   .hooks = {.flow = check}};

} // namespace feedhold::rules::parameter_without_meaning
