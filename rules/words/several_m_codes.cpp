// several-m-codes: `M08 M03`.
#include "findings/rule/rule.h"
#include "language/model/word_habits.h"
#include "rules/words/block_words.h"

#include <array>
#include <fmt/format.h>

namespace feedhold::rules::several_m_codes {
namespace {

/// LinuxCNC takes one M code of each of its groups.
bool checkGroups(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.behaviour.stopsAtStrayWords || context.tree.blocks[block].has(Block::kBroken))
    return false;
  std::array<const Word *, 16> ofGroup{};
  for (const Word &word : context.tree.wordsOf(block)) {
    const Code *code = word.address() == 'M' ? codeOf(word, context.dialect) : nullptr;
    if (!code || code->group == 0 || code->group >= ofGroup.size())
      continue;
    const Word *&first = ofGroup[code->group];
    if (first) {
      reporter.report({.message = fmt::format("{} and {} exclude each other: both are in one group of M codes",
                                              context.quoted(first->span()), context.quoted(word.span())),
                       .span = word.span(),
                       .labels = {{first->span(), "the first one"}},
                       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::DuplicateAddress)),
                                 "put each of them in a block of its own"}},
                      Severity::Error);
      return true;
    }
    first = &word;
  }
  return false;
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto [first, last, count] = mCodesOf(context.tree, block);
  const std::size_t mostEver = context.dialect.limits.mCodes;
  const Switch setting = context.dialect.switches.m3b;
  if (count >= 2 && checkGroups(block, context, reporter))
    return;
  if (count < 2 || (setting == Switch::On && count <= mostEver) || passesArguments(context, block))
    return;
  const bool sure = setting == Switch::Off || count > mostEver;
  const std::string_view off = context.dialect.hasFanucParameters
                                   ? "with parameter 3404#7 (M3B) off the control executes only the last one"
                                   : "many machines execute only the last one (`m3b` in feedhold.toml)";
  reporter.report({.message = fmt::format("{} M codes in one block", count),
                   .span = last->span(),
                   .labels = {{first->span(), "the first one"}},
                   .notes = {mostEver == 1      ? std::string("the control takes only one M code in a block")
                             : count > mostEver ? fmt::format("no setting of the control allows more than {}", mostEver)
                             : sure             ? std::string("the control executes only the last one")
                                                : std::string(off),
                             "put each M code in its own block"}},
                  sure ? Severity::Warning : Severity::Info);
}

} // namespace

extern const Rule severalMCodes;
const Rule severalMCodes{.info = {"several-m-codes", Category::Word, Severity::Info,
                                  "Reports more M codes in a block than every machine executes: one, or three where "
                                  "parameter 3404#7 (M3B) is on."},
                         .hooks = {.block = check}};

} // namespace feedhold::rules::several_m_codes
