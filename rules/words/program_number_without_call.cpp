// program-number-without-call: a block `P9832`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::program_number_without_call {
namespace {

constexpr std::uint32_t kFirstUsualNumber = 1000; // below, P is as likely a dwell or a number of something else

/// The P of a block that has nothing else but its sequence number.
const Word *onlyProgramNumber(const FileContext &context, BlockId block) {
  const Word *found = nullptr;
  for (const Word &word : context.tree.wordsOf(block)) {
    if (word.address() == 'N')
      continue;
    const bool isNumber = word.address() == 'P' && !word.has(Word::kPoint) && !word.has(Word::kComma) &&
                          !word.has(Word::kArgument) && word.integer().value_or(0) >= kFirstUsualNumber;
    if (found || !isNumber)
      return nullptr;
    found = &word;
  }
  return found;
}

/// Every block between G66 and G67 passes its words.
bool hasModalCall(const FileContext &context, BlockId block) {
  const auto calls = context.model.callsOf(context.model.programOf(block));
  return std::ranges::any_of(
      calls, [](const Call &call) { return call.kind == CallKind::Modal || call.kind == CallKind::ModalEach; });
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Block &its = context.tree.blocks[block];
  if (its.has(Block::kData) || its.has(Block::kBroken) || !context.tree.statementsOf(block).empty())
    return;
  const Word *number = onlyProgramNumber(context, block);
  if (!number || hasModalCall(context, block))
    return;
  reporter.report(
      {.message = fmt::format("{} calls nothing: its `G65` or `M98` is missing", context.quoted(number->span())),
       .span = number->span(),
       .notes = {"the control reads over this block, and the program is not called",
                 "write the call, or delete the block"}});
}

} // namespace

extern const Rule programNumberWithoutCall;
const Rule programNumberWithoutCall{.info = {"program-number-without-call", Category::Word, Severity::Warning,
                                             "Reports a block with the number of a program and no code that calls it."},
                                    .hooks = {.block = check}};

} // namespace feedhold::rules::program_number_without_call
