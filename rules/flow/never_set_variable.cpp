// never-set-variable: a main program uses `#30` and nothing ever sets it.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules {
namespace {

std::string_view effectOf(ReadUse use) {
  switch (use) {
  case ReadUse::Word: return "the word counts as not written";
  case ReadUse::Ordering: return "the comparison takes it for 0";
  case ReadUse::Copied: return "the copy is vacant, too";
  case ReadUse::Equality:
  case ReadUse::Computed:
  case ReadUse::Argument:
  case ReadUse::Other: return "it counts as 0 here";
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
        {.message = fmt::format("{} is used here and {}", context.quoted(span),
                                never ? "never set" : "has not been set before"),
         .span = span,
         .notes = {fmt::format("a local variable is vacant when the program starts: {}", effectOf(read.use)),
                   "set it before, or name the variable that was meant"}});
  }
}

} // namespace

extern const Rule neverSetVariable;
const Rule neverSetVariable{.info = {"never-set-variable", Category::Flow, Severity::Warning,
                                     "Reports a local variable that a main program uses before anything has set it."},
                            .hooks = {.flow = check}};

} // namespace feedhold::rules
