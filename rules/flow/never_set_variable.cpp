// never-set-variable: a main program uses `#30` and nothing ever sets it.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

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

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!isMainProgram(facts))
    return;
  std::vector<std::uint32_t> done;
  for (const Read &read : readsOf(facts)) {
    // What a call passes is another rule's.
    if (!read.number || read.use == ReadUse::Argument || std::ranges::find(done, *read.number) != done.end() ||
        !isVacantAt(facts, read))
      continue;
    done.push_back(*read.number);
    if (isTestedForVacancy(facts.file, facts.program, *read.number))
      continue;
    const bool never = isNeverSet(facts, *read.number);
    const Span span = context.tree.expressions[read.expression].span;
    reporter.report(
        {.message =
             fmt::format("{} is used here {}", context.quoted(span), never ? "but never set" : "before it is set"),
         .span = span,
         .notes = {fmt::format("local variables are vacant when the program starts: {}", effectOf(read.use)),
                   "set it before this block, or correct the variable number"}});
  }
}

} // namespace

extern const Rule neverSetVariable;
const Rule neverSetVariable{.info = {"never-set-variable", Category::Flow, Severity::Warning,
                                     "Reports a local variable that a main program uses before it is set."},
                            .hooks = {.flow = check}};

} // namespace feedhold::rules::never_set_variable
