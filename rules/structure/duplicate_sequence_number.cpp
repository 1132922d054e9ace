// duplicate-sequence-number: `N10` twice in a program, though no jump uses it.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace feedhold::rules::duplicate_sequence_number {
namespace {

std::unordered_set<std::uint32_t> jumpNumbers(ProgramId program, const FileContext &context) {
  std::unordered_set<std::uint32_t> numbers;
  for (const Jump &jump : context.model.jumpsOf(program))
    if (const auto number = targetNumber(jump))
      numbers.insert(*number);
  return numbers;
}

struct Repeated {
  SequenceNumber first;
  SequenceNumber second;
};

/// The first two blocks of every repeated number that no jump uses.
std::vector<Repeated> repeatedNumbers(ProgramId program, const FileContext &context) {
  const auto labels = sortedSequenceNumbers(context.model, program);
  const auto used = jumpNumbers(program, context);
  std::vector<Repeated> found;
  for (std::size_t i = 1; i < labels.size(); ++i) {
    const bool isSecond =
        labels[i].number == labels[i - 1].number && (i == 1 || labels[i - 2].number != labels[i].number);
    if (isSecond && !used.contains(labels[i].number))
      found.push_back({labels[i - 1], labels[i]});
  }
  return found;
}

/// One finding for the program: numbers that start anew at each tool would give thousands.
void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.grammar.sequenceJumps)
    return;
  const auto repeated = repeatedNumbers(program, context);
  if (repeated.empty())
    return;
  const Repeated &first = *std::ranges::min_element(repeated, {}, [](const Repeated &r) { return r.second.block; });
  const std::string message =
      repeated.size() == 1 ? fmt::format("`N{}` occurs more than once in this program", first.second.number)
                           : fmt::format("`N{}` and {} other sequence number{} occur more than once in this program",
                                         first.second.number, repeated.size() - 1, repeated.size() == 2 ? "" : "s");
  reporter.report({.message = message,
                   .span = context.tree.words[first.second.word].span(),
                   .labels = {{context.tree.words[first.first.word].span(), "first used here"}},
                   .notes = {"no jump uses it, but a sequence number search at the machine may find the wrong block"}});
}

} // namespace

extern const Rule duplicateSequenceNumber;
const Rule duplicateSequenceNumber{
    .info = {"duplicate-sequence-number", Category::Structure, Severity::Info,
             "Reports a sequence number that several blocks of a program have, when no jump uses it."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::duplicate_sequence_number
