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

bool isBare(BlockId block, const FileContext &context) {
  return context.tree.wordsOf(block).size() == 1 && context.tree.statementsOf(block).empty();
}

/// Down to the next label, which is a target: absent if something stands between.
std::optional<SequenceNumber> labelBehind(BlockId block, ProgramId program, const FileContext &context) {
  const BlockId last = context.model.programs[program].last;
  do
    block = block.next();
  while (block < last && isEmpty(context.tree, block));
  const auto labels =
      block < last ? context.model.sequenceNumbersIn(block, block.next()) : std::span<const SequenceNumber>{};
  return labels.empty() ? std::nullopt : std::optional(labels.front());
}

bool isJumpedTo(std::uint32_t number, BlockId before, ProgramId program, const FileContext &context) {
  return std::ranges::any_of(context.model.jumpsOf(program), [&](const Jump &jump) {
    return jump.kind == JumpKind::Goto && jump.conditional && jump.block < before && targetNumber(jump) == number;
  });
}

/// `IF[..]GOTO2`, one way, `N3` alone, `N2`, the other way, `N3`: the first N3 is a jump without its `GOTO`.
void checkLostJump(const Repeated &repeated, ProgramId program, const FileContext &context, const Reporter &reporter) {
  const BlockId block = repeated.first.block;
  const auto other = isBare(block, context) ? labelBehind(block, program, context) : std::nullopt;
  if (!other || other->block >= repeated.second.block || other->number == repeated.first.number ||
      !isJumpedTo(other->number, block, program, context))
    return;
  const Span label = context.tree.words[repeated.first.word].span();
  const std::string jump = fmt::format("GOTO{}", repeated.first.number);
  reporter.report(
      {.message = fmt::format("{} is a label where a jump seems to be meant", context.quoted(label)),
       .span = label,
       .labels = {{context.tree.words[repeated.second.word].span(), "the label of this number"},
                  {context.tree.words[other->word].span(), "begins what a jump above leads to"}},
       .notes = {"the blocks above it are followed by those of the other case", fmt::format("write `{}`", jump)},
       .fixes = {{.title = fmt::format("write `{}`", jump), .edits = {{label, jump}}}}},
      Severity::Warning);
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
  for (const Repeated &each : repeated)
    checkLostJump(each, program, context, reporter);
}

} // namespace

extern const Rule duplicateSequenceNumber;
const Rule duplicateSequenceNumber{
    .info = {"duplicate-sequence-number", Category::Structure, Severity::Info,
             "Reports a sequence number that several blocks of a program have, when no jump uses it."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::duplicate_sequence_number
