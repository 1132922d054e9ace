// duplicate-address: `X1. Y2. X3.`.
#include "findings/rule/rule.h"

#include "rules/words/block_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::rules::duplicate_address {
namespace {

bool isSign(char address, const FileContext &context) {
  return context.dialect.grammar.signAddresses.find(address) != std::string_view::npos;
}

bool counts(const Word &word, const FileContext &context) {
  if (isSign(word.address(), context))
    return true;
  return word.address() != 'G' && word.address() != 'M' && !word.has(Word::kComma) && !word.has(Word::kAfterThen) &&
         !word.has(Word::kAfterSkip) && formatOf(context.dialect, word.address()).kind != AddressKind::None;
}

constexpr std::int64_t kToolChange = 6; // M06

/// `T2 T0 M6`: the tool that comes into the spindle, and the one that the changer prepares (Mazak, EIA/ISO programs).
bool namesNextTool(std::span<const Word> words, const Word &word) {
  return word.address() == 'T' && std::ranges::any_of(words, [](const Word &other) {
           return other.address() == 'M' && other.isNumber() && other.number().asInteger() == kToolChange;
         });
}

void reportPair(const Word &first, const Word &second, const FileContext &context, const Reporter &reporter) {
  const bool alarm = context.dialect.switches.ad2 == Switch::On;
  reporter.report(
      {.message = fmt::format("`{}` occurs twice in one block", second.address()),
       .span = second.span(),
       .labels = {{first.span(), "the first one"}},
       .notes = {alarm ? fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::DuplicateAddress))
                       : std::string("the control uses the last one, without any message"),
                 "correct the address, delete one of the words, or restore a lost line end"}},
      alarm ? Severity::Error : Severity::Warning);
}

/// LinuxCNC refuses it beside `G10` and `M6`, too.
bool isRefused(BlockId block, const FileContext &context) {
  return context.dialect.behaviour.stopsAtStrayWords && context.model.callsIn(block, block.next()).empty();
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto words = context.tree.wordsOf(block);
  if (words.size() < 2 || context.tree.blocks[block].has(Block::kData))
    return;
  std::array<const Word *, 128> seen{};
  for (const Word &word : words) {
    if (!counts(word, context)) // a `<NAME>` has no letter
      continue;
    const Word *&first = seen[static_cast<std::size_t>(word.address() & 0x7f)];
    if (first) {
      if (isRefused(block, context) || (!meansOwnWords(context, block) && !namesNextTool(words, word)))
        reportPair(*first, word, context, reporter);
      return;
    }
    first = &word;
  }
}

} // namespace

extern const Rule duplicateAddress;
const Rule duplicateAddress{.info = {"duplicate-address", Category::Word, Severity::Warning,
                                     "Reports an address that occurs twice in one block."},
                            .hooks = {.block = check}};

} // namespace feedhold::rules::duplicate_address
