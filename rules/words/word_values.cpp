// What numbers a word has.
#include "rules/words/word_values.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules {

Outside outsideOf(const AbstractValue &value, const AllowedNumbers &allowed) {
  if (!value.mayBeNumber())
    return Outside::Never;
  const Interval &range = value.number().interval();
  if (value.isNumber() && (range.hi < allowed.least || range.lo > allowed.most))
    return Outside::Always;
  const FiniteSet &few = value.number().set();
  if (few.isMany() || std::ranges::all_of(few.values(), [&](double each) { return allowed.contains(each); }))
    return Outside::Never;
  const bool none = std::ranges::none_of(few.values(), [&](double each) { return allowed.contains(each); });
  return none && value.isNumber() ? Outside::Always : Outside::Sometimes;
}

double wrongNumberOf(const AbstractValue &value, const AllowedNumbers &allowed) {
  for (const double each : value.number().set().values())
    if (!allowed.contains(each))
      return each;
  const Interval &range = value.number().interval();
  return range.hi < allowed.least ? range.hi : range.lo;
}

std::vector<ComputedWord> computedWordsOf(const FlowFacts &facts) {
  std::vector<ComputedWord> found;
  const SyntaxTree &tree = *facts.file.tree;
  std::optional<BlockId> last; // several nodes may execute one block
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const BlockId block = facts.node(node).block;
    if (!facts.isReached(node) || block == last || tree.wordsOf(block).size() > kMostWords)
      continue;
    last = block;
    for (const Word &word : tree.wordsOf(block)) {
      if (word.form() != WordForm::Expression || word.has(Word::kArgument) || word.has(Word::kAfterSkip))
        continue;
      if (const AbstractValue *value = facts.valueOf(word.expression()))
        found.push_back({&word, block, node, value});
    }
  }
  return found;
}

std::vector<Label> pathOf(const FlowFacts &facts, const ComputedWord &computed, Outside outside) {
  return outside == Outside::Always ? pathFromEntry(facts, computed.node) : std::vector<Label>{};
}

std::string describeNumber(const AbstractValue &value, const AllowedNumbers &allowed, Outside outside) {
  const double wrong = wrongNumberOf(value, allowed);
  const bool isKnown = value.number().set().contains(wrong) && !value.number().set().isMany();
  if (isKnown)
    return fmt::format("{} {:.10g} here", outside == Outside::Always ? "is" : "can be", wrong);
  return wrong < allowed.least ? fmt::format("is {:.10g} or less here", wrong)
                               : fmt::format("is {:.10g} or more here", wrong);
}

} // namespace feedhold::rules
