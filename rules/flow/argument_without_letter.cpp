// argument-without-letter: `IF[#16EQ#0]THEN#16=0` in a macro that takes P for an argument.
#include "rules/comments/header_call.h"
#include "rules/flow/definitions.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::argument_without_letter {
namespace {

constexpr std::uint32_t kLastLetter = 26; // Z

/// Some letters of a call pass nothing; this one would fill the variable, by the order of the list of arguments.
char seemingLetter(std::uint32_t variable) {
  switch (variable) {
  case 10: return 'G';
  case 12: return 'L';
  case 14: return 'N';
  case 15: return 'O';
  case 16: return 'P';
  default: return '\0';
  }
}

/// `#16EQ#0`, of a local variable that is as it was at the start of the program.
std::optional<Read> askedAt(const FlowFacts &facts, const FileContext &context, NodeId node) {
  const auto *test = std::get_if<Test>(&facts.node(node).instruction);
  if (!test || !test->condition || !facts.isReached(node))
    return std::nullopt;
  const auto *relation = asInside<BinaryOperation>(context.tree, *test->condition);
  if (!relation || !isRelation(relation->op) || !isVacant(context, relation->right))
    return std::nullopt;
  for (const Read &read : readsIn(facts.file, relation->left, facts.node(node).block)) {
    if (!read.number || *read.number > kLastLetter || seemingLetter(*read.number) == '\0' ||
        isParameter(facts, *read.number) || !isLocal(facts.file, *read.number))
      continue;
    const auto known = definitionsOf(facts, *read.number, node);
    if (known && known->fromEntry && known->nodes.empty())
      return read;
  }
  return std::nullopt;
}

/// Arguments with a letter of which the program asks whether they were passed.  By argument assignment II, repeated I,
/// J and K fill the locals without a letter.
std::size_t lettersAsked(const FlowFacts &facts, const FileContext &context) {
  constexpr std::uint32_t kLastOfFirstSet = 6;
  std::set<std::uint32_t> asked;
  for (const Read &read : readsOf(facts)) {
    const bool hasLetter = read.number && *read.number > kLastOfFirstSet && *read.number <= kLastLetter &&
                           letterOfArgument(context.dialect, *read.number);
    if (hasLetter && isTestedForVacancy(facts.file, facts.program, *read.number))
      asked.insert(*read.number);
  }
  return asked.size();
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  constexpr std::size_t kFewest = 2;
  if (!context.dialect.grammar.sequenceJumps || isTooLarge(facts) || isMainProgram(facts) ||
      isCalledAsSubprogram(facts))
    return;
  const auto header = headerCallOf(context, facts.program);
  const bool asksLetters = lettersAsked(facts, context) >= kFewest;
  std::vector<Read> found;
  std::set<std::uint32_t> variables;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (const auto read = askedAt(facts, context, node); read && variables.insert(*read->number).second)
      found.push_back(*read);
  if (found.size() != 1) // several: sets of I, J and K
    return;
  const Read &read = found.front();
  if (!asksLetters && (!header || !header->letters.contains(seemingLetter(*read.number))))
    return;
  reporter.report(
      {.message = fmt::format("no letter passes `#{}`: it is vacant in every call by letters", *read.number),
       .span = context.tree.expressions[read.expression].span,
       .notes = {fmt::format("{} of a call is no argument; the letters G, L, N, O and P are left out of the list",
                             seemingLetter(*read.number)),
                 "use a letter that is passed, such as U (#21) or W (#23)"}});
}

} // namespace

extern const Rule argumentWithoutLetter;
const Rule argumentWithoutLetter{.info = {"argument-without-letter", Category::Flow, Severity::Warning,
                                          "Reports a macro that asks whether an argument was passed for which there "
                                          "is no letter."},
                                 .hooks = {.flow = check}};

} // namespace feedhold::rules::argument_without_letter
