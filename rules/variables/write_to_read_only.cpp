// write-to-read-only: `#5041=0`, and `#[#1]=0` where #1 is 5041.
#include "rules/variables/computed_number.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>

namespace feedhold::rules::write_to_read_only {
namespace {

std::string contents(const VariableRange &range) {
  return range.meaning.empty() ? std::string("it is read-only") : fmt::format("it holds: {}", range.meaning);
}

/// `#<_x> = 4`: case and blanks do not matter.
void checkName(const VariableUse &use, const FileContext &context, const Reporter &reporter) {
  const Expression &expression = context.tree.expressions[use.expression];
  const auto *named = use.write ? std::get_if<NamedVariable>(&expression.node) : nullptr;
  if (named && predefinedNamed(context.dialect, comparedName(context.text(named->name))))
    reporter.report({.message = fmt::format("{} can only be read, not written", context.quoted(expression.span)),
                     .span = expression.span,
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WriteProtected)),
                               "it has a meaning of its own: choose another name"}});
}

void check(const VariableUse &use, const FileContext &context, const Reporter &reporter) {
  checkName(use, context, reporter);
  const VariableRange *range = use.write && use.number ? findVariable(context.dialect, *use.number) : nullptr;
  if (!range || range->access != VariableAccess::ReadOnly || range->kind == VariableKind::Vacant)
    return;
  const Span span = context.tree.expressions[use.expression].span;
  reporter.report({.message = fmt::format("{} can only be read, not written", context.quoted(span)),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WriteProtected)),
                             contents(*range)}});
}

void checkComputed(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const ComputedNumber &computed : computedNumbersOf(facts)) {
    const auto isReadOnly = [&](std::uint32_t number) {
      const VariableRange *range = findVariable(context.dialect, number);
      return range && (range->access == VariableAccess::ReadOnly || range->kind == VariableKind::Vacant);
    };
    const auto found = std::ranges::find_if(computed.numbers, isReadOnly);
    if (!computed.isWritten || found == computed.numbers.end())
      continue;
    const bool always = std::ranges::all_of(computed.numbers, isReadOnly);
    reporter.report({.message = fmt::format("{} {} `#{}`, which can only be read", context.quoted(computed.place),
                                            always ? "is" : "can be", *found),
                     .span = computed.place,
                     .flow = always ? pathFromEntry(facts, computed.node) : std::vector<Label>{},
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WriteProtected)),
                               contents(*findVariable(context.dialect, *found))}},
                    always ? Severity::Error : Severity::Warning);
  }
}

} // namespace

extern const Rule writeToReadOnly;
const Rule writeToReadOnly{.info = {"write-to-read-only", Category::Variable, Severity::Error,
                                    "Reports an assignment to a system variable that can only be read."},
                           .hooks = {.variable = check, .flow = checkComputed}};

} // namespace feedhold::rules::write_to_read_only
