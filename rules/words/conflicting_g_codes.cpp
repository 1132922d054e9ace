// conflicting-g-codes: `G90 G91 X1.`.
#include "findings/rule/rule.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace feedhold::rules::conflicting_g_codes {
namespace {

void reportPair(const Word &first, const Word &second, const FileContext &context, const Reporter &reporter) {
  const bool alarm = context.dialect.switches.ad2 == Switch::On;
  reporter.report(
      {.message = fmt::format("{} and {} exclude each other: both are in one modal group", context.quoted(first.span()),
                              context.quoted(second.span())),
       .span = second.span(),
       .labels = {{first.span(), "the first one"}},
       .notes = {alarm ? fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::DuplicateAddress))
                       : std::string("the control uses the last one for the whole block, also for the words before it"),
                 "delete one of the two, or put it in a block of its own"}},
      alarm ? Severity::Error : Severity::Warning);
}

bool isCode(const Word &word) { return word.address() == 'G' && !word.has(Word::kAfterSkip); }

/// G80 before a motion, where both are of one group: the motion holds.
bool maySupersede(const Code &code, const Dialect &dialect) {
  const Code *rapid = findGCode(dialect, 0);
  return code.action == CodeAction::CycleOff && rapid && rapid->group == code.group;
}

/// G53 and G31: both say what the axis words of their block mean.
void reportTwoMeanings(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *machine = findCode(context.tree, block, context.dialect, CodeRole::MachinePosition);
  const Word *skip = machine ? findCode(context.tree, block, context.dialect, CodeRole::Skip) : nullptr;
  if (!skip || machine->has(Word::kAfterSkip) || skip->has(Word::kAfterSkip))
    return;
  reporter.report({.message = fmt::format("{} and {} exclude each other: both move by the axis words of the block",
                                          context.quoted(machine->span()), context.quoted(skip->span())),
                   .span = skip->span(),
                   .labels = {{machine->span(), "machine coordinates"}},
                   .notes = {"the control uses one of them: the probe moves to a work coordinate, or without looking "
                             "for the signal",
                             "compute the distance, and move by `G91` and the skip code"}},
                  // Some machine builders make a pair of it that works.
                  Severity::Info);
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto words = context.tree.wordsOf(block);
  if (words.size() < 2 || std::count_if(words.begin(), words.end(), isCode) < 2)
    return;
  reportTwoMeanings(block, context, reporter);
  std::array<const Word *, 256> ofGroup{};
  for (const Word &word : words) {
    const Code *code = isCode(word) ? codeOf(word, context.dialect) : nullptr;
    if (!code || code->group == 0 || maySupersede(*code, context.dialect))
      continue;
    const Word *&first = ofGroup[code->group];
    if (first && first->tenths() != word.tenths())
      reportPair(*first, word, context, reporter);
    first = &word;
  }
}

} // namespace

extern const Rule conflictingGCodes;
const Rule conflictingGCodes{.info = {"conflicting-g-codes", Category::Word, Severity::Warning,
                                      "Reports two different G codes of one modal group in one block."},
                             .hooks = {.block = check}};

} // namespace feedhold::rules::conflicting_g_codes
