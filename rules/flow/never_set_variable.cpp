// never-set-variable: a program uses `#30` and nothing ever sets it.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace feedhold::rules::never_set_variable {
namespace {

std::string_view effectOf(ReadUse use) {
  switch (use) {
  case ReadUse::Word: return "the control ignores this word";
  case ReadUse::Ordering: return "the comparison reads it as 0";
  case ReadUse::Copied: return "the copy is vacant, too";
  case ReadUse::Equality:
  case ReadUse::Computed:
  case ReadUse::Argument:
  case ReadUse::Other: return "it is read as 0 here";
  }
  return {};
}

/// The variable is vacant at its first use, whatever is assigned later.
bool isVacantAt(const FlowFacts &facts, const Read &read) {
  const AbstractValue *value = facts.valueOf(read.expression);
  if (!value || !value->mayBeVacant() || !isLocal(facts.file, *read.number) || *read.number == kVacantVariable)
    return false;
  if (isNeverSet(facts, *read.number))
    return true;
  const auto node = nodeOf(facts, read.block, read.expression);
  const UnsetPaths unset(facts, *read.number);
  return node && unset.reach(*node) && unset.isFirstUse(*node);
}

void tell(const Read &read, std::string_view what, std::string_view why, const FileContext &context,
          const Reporter &reporter) {
  const Span span = context.tree.expressions[read.expression].span;
  reporter.report({.message = fmt::format("{} is used here {}", context.quoted(span), what),
                   .span = span,
                   .notes = {fmt::format("{}: {}", why, effectOf(read.use)),
                             "set it before this block, or correct the variable number"}});
}

/// Only the eighth K of a call, and what comes behind it, could set them: nobody writes so many.
bool isBeyondArguments(const FlowFacts &facts, std::uint32_t variable) {
  constexpr std::uint32_t kFirst = 27;
  return variable >= kFirst && isLocal(facts.file, variable) && !letterOfArgument(*facts.file.dialect, variable);
}

/// It takes arguments, and shares its variables with no caller that could have set others.
bool takesArguments(const FlowFacts &facts) {
  constexpr std::size_t kFewestArguments = 3;
  if (!facts.file.dialect->behaviour.variablesMayBeVacant || isMainProgram(facts) || isCalledAsSubprogram(facts))
    return false;
  std::set<std::uint32_t> arguments;
  for (const Read &read : readsOf(facts))
    if (read.number && isParameter(facts, *read.number) && !maySet(facts, *read.number))
      arguments.insert(*read.number);
  return arguments.size() >= kFewestArguments;
}

/// `#32` for `#36`.  Where more of them are not set, a caller may set them, and call by M98.
void checkMacro(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  constexpr std::size_t kMostSlips = 2;
  std::map<std::uint32_t, const Read *> firstReads;
  const std::vector<Read> reads = readsOf(facts);
  for (const Read &read : reads)
    if (read.number && isBeyondArguments(facts, *read.number) && !maySet(facts, *read.number))
      firstReads.try_emplace(*read.number, &read);
  if (firstReads.empty() || firstReads.size() > kMostSlips || !takesArguments(facts))
    return;
  for (const auto &[variable, read] : firstReads) {
    if (isTestedForVacancy(facts.file, facts.program, variable))
      continue;
    tell(*read, "but never set", "no letter of a call sets it, so that it is vacant", context, reporter);
  }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!isMainProgram(facts))
    return checkMacro(facts, context, reporter);
  std::vector<std::uint32_t> done;
  for (const Read &read : readsOf(facts)) {
    // What a call passes is another rule's.
    if (!read.number || read.use == ReadUse::Argument || std::ranges::find(done, *read.number) != done.end() ||
        !isVacantAt(facts, read))
      continue;
    done.push_back(*read.number);
    if (isTestedForVacancy(facts.file, facts.program, *read.number))
      continue;
    tell(read, isNeverSet(facts, *read.number) ? "but never set" : "before it is set",
         "local variables are vacant when the program starts", context, reporter);
  }
}

} // namespace

extern const Rule neverSetVariable;
const Rule neverSetVariable{
    .info =
        {"never-set-variable", Category::Flow, Severity::Warning,
         "Reports a local variable that a main program uses before it is set, and one that a macro never sets and no "
         "argument can set."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::never_set_variable
