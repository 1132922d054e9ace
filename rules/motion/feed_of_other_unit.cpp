// feed-of-other-unit: `G01 X30. F0.2` and `G01 Z-40. F200` in one lathe program, and no code of the feed mode.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::feed_of_other_unit {
namespace {

/// Feeds that only fit one of the units: up to a millimetre in a revolution, or from 20 in a minute.
constexpr std::int64_t kMostPerRevolution = 1;
constexpr std::int64_t kLeastPerMinute = 20;

bool hasFeedMode(BlockId block, const FileContext &context) {
  return findAction(context.tree, block, context.dialect,
                    {CodeAction::FeedPerMinute, CodeAction::FeedPerRevolution, CodeAction::FeedInverse}) != nullptr;
}

bool isThreadOrCall(BlockId block, const FileContext &context) {
  return findAction(context.tree, block, context.dialect, {CodeAction::Thread}) ||
         findCode(context.tree, block, context.dialect, CodeRole::CannedCycle) ||
         !context.model.callsIn(block, block.next()).empty();
}

/// The first F of a program that is small, and the first that is large.
struct Feeds {
  const Word *perRevolution = nullptr;
  const Word *perMinute = nullptr;
};

void note(const Word &word, const FileContext &context, Feeds &feeds) {
  const Decimal &value = word.number();
  const bool isExact = word.has(Word::kPoint) || context.dialect.switches.dpi == Switch::On || !value.isInteger() ||
                       value >= Decimal(kLeastPerMinute, 0);
  if (!isExact || value.isZero())
    return;
  if (value <= Decimal(kMostPerRevolution, 0) && !feeds.perRevolution)
    feeds.perRevolution = &word;
  if (value >= Decimal(kLeastPerMinute, 0) && !feeds.perMinute)
    feeds.perMinute = &word;
}

/// Absent: a code says what feeds are counted by, or the program ends without one of the two.
std::optional<Feeds> feedsOf(ProgramId program, const FileContext &context) {
  Feeds feeds;
  const Program &whole = context.model.programs[program];
  for (BlockId block = whole.first; block < whole.last; block = block.next()) {
    if (hasFeedMode(block, context))
      return std::nullopt;
    if (isThreadOrCall(block, context))
      continue;
    for (const Word &word : context.tree.wordsOf(block))
      if (word.address() == 'F' && word.isNumber() && !word.has(Word::kArgument))
        note(word, context, feeds);
  }
  return feeds.perRevolution && feeds.perMinute ? std::optional(feeds) : std::nullopt;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  const auto feeds = feedsOf(program, context);
  if (!feeds)
    return;
  reporter.report(
      {.message = fmt::format("{} and {} are feeds of different units, and nothing changes the unit",
                              context.quoted(feeds->perMinute->span()), context.quoted(feeds->perRevolution->span())),
       .span = feeds->perMinute->span(),
       .labels = {{feeds->perRevolution->span(), "per revolution, by its size"}},
       .notes = {"one of them is wrong by a factor of some hundred: a lathe takes both per revolution, or both "
                 "per minute",
                 "write the code of the unit, such as `G99` for feed per revolution"}});
}

} // namespace

extern const Rule feedOfOtherUnit;
const Rule feedOfOtherUnit{
    .info = {"feed-of-other-unit", Category::Motion, Severity::Warning,
             "Reports a lathe program with feeds per revolution and per minute, and no code that "
             "changes the unit."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::feed_of_other_unit
