// variable-not-available: `#50`, `#250`: between the ranges; `#[#1]` where #1 is 50.
#include "rules/variables/computed_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace feedhold::rules::variable_not_available {
namespace {

constexpr std::size_t kForeignVariables = 4;
constexpr std::size_t kForeignBesideCodes = 2; // in a program with as many G codes that do not exist
constexpr std::uint32_t kFirstSystem = 1000;

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

using Uses = std::map<std::uint32_t, Span>; // of variables that the control does not have, where first

Uses usesOf(const FileContext &context) {
  Uses uses;
  for (const VariableUse &use : context.model.variables)
    if (use.number && !findVariable(context.dialect, *use.number))
      uses.emplace(*use.number, context.tree.expressions[use.expression].span);
  return uses;
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
void reportAll(const Uses &uses, const FileContext &context, const Reporter &reporter) {
  const auto first = std::ranges::min_element(uses, {}, [](const auto &use) { return use.second.begin; });
  reporter.report({.message = fmt::format("{} and {} more variables do not exist on {}", context.quoted(first->second),
                                          uses.size() - 1, context.dialect.id),
                   .span = first->second,
                   .notes = {"the program may be for another control: choose it with `dialect` in feedhold.toml",
                             "variables of the machine builder are listed under `builders-variables` there"}},
                  Severity::Warning);
}

/// Each G code that the control does not have, where first.
std::map<std::string, Span> foreignCodesOf(const FileContext &context) {
  std::map<std::string, Span> codes;
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i) {
    if (context.tree.blocks[BlockId(i)].has(Block::kAfterEnd))
      continue;
    for (const Word &word : context.tree.wordsOf(BlockId(i))) {
      const bool isCode = word.address() == 'G' && word.isNumber() && !word.has(Word::kArgument);
      const auto tenths = isCode ? word.tenths() : std::nullopt;
      if (isCode && !(tenths && hasGCode(context.dialect, *tenths)))
        codes.emplace(std::string(context.text(word.span())), word.span());
    }
  }
  return codes;
}

void reportOtherControl(const Uses &uses, const std::map<std::string, Span> &codes, const FileContext &context,
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
  const Uses uses = usesOf(context);
  // One code is the builder's own on many machines; beside a slip or two it says nothing.  `#42` alone is a slip on
  // every control; a lone system variable may be one of the control that has the codes.
  const bool isForeign = uses.size() >= kForeignBesideCodes || (!uses.empty() && uses.begin()->first >= kFirstSystem);
  const auto codes = isForeign ? foreignCodesOf(context) : std::map<std::string, Span>();
  if (codes.size() >= kForeignBesideCodes || (!codes.empty() && uses.size() >= kForeignVariables))
    return reportOtherControl(uses, codes, context, reporter);
  if (uses.size() >= kForeignVariables)
    return reportAll(uses, context, reporter);
  for (const auto &[number, place] : uses)
    reportOne(number, place, context, reporter);
}

/// Sure where the program computes one number, or one of a few.
void checkComputed(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const ComputedNumber &computed : computedNumbersOf(facts)) {
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
    reporter.report(std::move(diagnostic), always ? Severity::Error : Severity::Warning);
  }
}

} // namespace

extern const Rule variableNotAvailable;
const Rule variableNotAvailable{.info = {"variable-not-available", Category::Variable, Severity::Error,
                                         "Reports a variable number that no machine with this control has."},
                                .hooks = {.file = check, .flow = checkComputed}};

} // namespace feedhold::rules::variable_not_available
