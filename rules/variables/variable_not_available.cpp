// variable-not-available: `#50`, `#250`: between the ranges; `#[#1]` where #1 is 50.
#include "findings/rule/other_control.h"
#include "rules/variables/computed_number.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::variable_not_available {
namespace {

/// The nearest ranges around a number that is in none, for "the control has #1-#33 and #100-#199".
std::string neighbours(const Dialect &dialect, std::uint32_t number) {
  const VariableRange *below = nullptr;
  const VariableRange *above = nullptr;
  for (const VariableRange &range : dialect.variables) {
    if (range.last < number)
      below = &range;
    else if (!above)
      above = &range;
  }
  const auto shown = [](const VariableRange *range) {
    return range->first == range->last ? fmt::format("#{}", range->first)
                                       : fmt::format("#{}-#{}", range->first, range->last);
  };
  if (!below || !above)
    return fmt::format("the {} variables are {}", below ? "last" : "first", shown(below ? below : above));
  return fmt::format("the nearest variables are {} and {}", shown(below), shown(above));
}

/// Once, where it is used first.
void reportOne(std::uint32_t number, Span place, const FileContext &context, const Reporter &reporter) {
  const auto more = std::ranges::count(context.model.variables, std::optional(number), &VariableUse::number) - 1;
  Diagnostic diagnostic{
      .message = fmt::format("{} does not have {}", context.dialect.id, context.quoted(place)),
      .span = place,
      .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::VariableNotAvailable)),
                neighbours(context.dialect, number)}};
  if (more > 0)
    diagnostic.notes.push_back(fmt::format("it is used {} more time{}", more, more == 1 ? "" : "s"));
  reporter.report(std::move(diagnostic));
}

/// One slip names one variable; a program for another control, or for the options of a machine, names many.
void reportAll(const MissingVariables &uses, const FileContext &context, const Reporter &reporter) {
  const auto first = std::ranges::min_element(uses, {}, [](const auto &use) { return use.second.begin; });
  reporter.report({.message = fmt::format("{} and {} more variables do not exist on {}", context.quoted(first->second),
                                          uses.size() - 1, context.dialect.id),
                   .span = first->second,
                   .notes = {"the program may be for another control: choose it with `dialect` in feedhold.toml",
                             "variables of the machine builder are listed under `builders-variables` there"}},
                  Severity::Warning);
}

void reportOtherControl(const MissingVariables &uses, const MissingCodes &codes, const FileContext &context,
                        const Reporter &reporter) {
  const auto begin = [](const auto &each) { return each.second.begin; };
  const Span variable = std::ranges::min_element(uses, {}, begin)->second;
  const Span code = std::ranges::min_element(codes, {}, begin)->second;
  const auto andMore = [](std::size_t count, std::string_view what) {
    return count == 1 ? "" : fmt::format(" and {} more {}{}", count - 1, what, count == 2 ? "" : "s");
  };
  reporter.report(
      {.message = fmt::format("the program seems to be for another control: {} has neither {}{} nor {}{}",
                              context.dialect.id, context.quoted(variable), andMore(uses.size(), "variable"),
                              context.quoted(code), andMore(codes.size(), "G code")),
       .span = variable,
       .labels = {{code, "the first of the codes"}},
       .notes = {"choose the control with `dialect` in feedhold.toml",
                 "variables of the machine builder are listed under `builders-variables` there, codes under "
                 "`builders-codes`"}},
      Severity::Info);
}

void check(const FileContext &context, const Reporter &reporter) {
  const MissingVariables uses = missingVariablesOf(context);
  const MissingCodes codes = uses.empty() ? MissingCodes() : missingCodesOf(context);
  if (!uses.empty() && isOfOtherControl(uses, codes))
    return reportOtherControl(uses, codes, context, reporter);
  if (uses.size() >= kForeignVariables)
    return reportAll(uses, context, reporter);
  for (const auto &[number, place] : uses)
    reportOne(number, place, context, reporter);
}

/// Sure where the program computes one number, or one of a few.
void checkComputed(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const std::vector<ComputedNumber> computedNumbers = computedNumbersOf(facts);
  const bool isOfOther = !computedNumbers.empty() && seemsForOtherControl(context);
  for (const ComputedNumber &computed : computedNumbers) {
    const auto isMissing = [&](std::uint32_t number) { return !findVariable(context.dialect, number); };
    const auto missing = std::ranges::find_if(computed.numbers, isMissing);
    if (missing == computed.numbers.end() && !computed.isNegative)
      continue;
    const bool always = computed.isNegative || std::ranges::all_of(computed.numbers, isMissing);
    const std::string what = computed.isNegative ? std::string("is negative here")
                                                 : fmt::format("{} {} here", always ? "is" : "can be", *missing);
    Diagnostic diagnostic{
        .message = fmt::format("the number of {} {}", context.quoted(computed.place), what),
        .span = computed.place,
        .flow = always ? pathFromEntry(facts, computed.node) : std::vector<Label>{},
        .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::VariableNotAvailable))}};
    if (!computed.isNegative)
      diagnostic.notes.push_back(neighbours(context.dialect, *missing));
    reporter.report(std::move(diagnostic), isOfOther ? Severity::Info : always ? Severity::Error : Severity::Warning);
  }
}

} // namespace

extern const Rule variableNotAvailable;
const Rule variableNotAvailable{.info = {"variable-not-available", Category::Variable, Severity::Error,
                                         "Reports a variable number that no machine with this control has."},
                                .hooks = {.file = check, .flow = checkComputed}};

} // namespace feedhold::rules::variable_not_available
