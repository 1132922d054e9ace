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

/// `G90 G90`: harmless elsewhere.
void reportTwice(const Word &first, const Word &second, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} occurs twice in one block", context.quoted(second.span())),
                   .span = second.span(),
                   .labels = {{first.span(), "the first one"}},
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::DuplicateAddress)),
                             "delete one of the two"}},
                  Severity::Error);
}

bool isCode(const Word &word) { return word.address() == 'G' && !word.has(Word::kAfterSkip); }

/// G80 before a motion, where both are of one group: the motion holds.
bool maySupersede(const Code &code, const Dialect &dialect) {
  const Code *rapid = findGCode(dialect, 0);
  return code.action == CodeAction::CycleOff && rapid && rapid->group == code.group;
}

/// `G90 G00 X50.` on a lathe: in G code systems B and C, G90 is no cycle but absolute programming.
bool isOfOtherSystem(const Word &first, const Word &second, const Dialect &dialect) {
  constexpr std::uint16_t kG90 = 900;
  const auto isMotion = [&](const Word &word) {
    const Code *code = codeOf(word, dialect);
    return code && (code->role == CodeRole::Motion || code->role == CodeRole::Arc);
  };
  return dialect.machine == MachineKind::Turning &&
         ((first.tenths() == kG90 && isMotion(second)) || (second.tenths() == kG90 && isMotion(first)));
}

const Word *findActive(BlockId block, const FileContext &context, CodeRole role) {
  const Word *word = findCode(context.tree, block, context.dialect, role);
  return word && !word->has(Word::kAfterSkip) ? word : nullptr;
}

/// G53 with G31 or G28: both say what the axis words of their block mean.
void reportTwoMeanings(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *machine = findActive(block, context, CodeRole::MachinePosition);
  const Word *skip = machine ? findActive(block, context, CodeRole::Skip) : nullptr;
  const Word *reference = machine ? findActive(block, context, CodeRole::ReferenceReturn) : nullptr;
  const Word *other = skip ? skip : reference;
  if (!other)
    return;
  const std::string consequence =
      skip ? "the control uses one of them: the probe moves to a work coordinate, or without looking for the signal"
           : "the control uses one of them: the axes move through a point in other coordinates, or stop short of the "
             "reference position";
  const std::string remedy = skip ? "compute the distance, and move by `G91` and the skip code"
                                  : fmt::format("keep {} with machine coordinates, or {} with `G91`",
                                                context.quoted(machine->span()), context.quoted(other->span()));
  reporter.report({.message = fmt::format("{} and {} exclude each other: both move by the axis words of the block",
                                          context.quoted(machine->span()), context.quoted(other->span())),
                   .span = other->span(),
                   .labels = {{machine->span(), "machine coordinates"}},
                   .notes = {consequence, remedy}},
                  // Some machine builders make a pair with the skip code that works.
                  skip ? Severity::Info : Severity::Warning);
}

/// What LinuxCNC refuses beyond its modal groups: pairs of which each wants the words of the block for itself.
void reportRefused(const Word &first, const Word &second, std::string_view why, const FileContext &context,
                   const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} and {} exclude each other: {}", context.quoted(first.span()),
                                          context.quoted(second.span()), why),
                   .span = second.span(),
                   .labels = {{first.span(), "the first one"}},
                   .notes = {"the control stops with an error", "put each of them in a block of its own"}},
                  Severity::Error);
}

void checkNgc(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (context.tree.blocks[block].has(Block::kBroken))
    return;
  const Word *once = nullptr; // of the codes that are not modal
  const Word *motion = nullptr;
  const Code *rapid = findGCode(context.dialect, 0);
  for (const Word &word : context.tree.wordsOf(block)) {
    const Code *code = isCode(word) ? codeOf(word, context.dialect) : nullptr;
    if (!code || !rapid)
      continue;
    if (code->group == 0 && once)
      return reportRefused(*once, word, "a block has one of the codes that hold for their block only", context,
                           reporter);
    if (code->group == 0)
      once = &word;
    else if (code->group == rapid->group && code->action != CodeAction::CycleOff)
      motion = &word;
  }
  const Code *single = once ? codeOf(*once, context.dialect) : nullptr;
  const Code *moving = motion ? codeOf(*motion, context.dialect) : nullptr;
  if (!single || !moving)
    return;
  const bool isStraight = moving->action == CodeAction::Rapid || moving->action == CodeAction::Linear;
  if (single->role == CodeRole::Dwell && moving->role == CodeRole::Arc)
    reportRefused(*once, *motion, "both have a P", context, reporter);
  else if (single->role == CodeRole::MachinePosition && !isStraight)
    reportRefused(*once, *motion, "machine coordinates are for `G0` and `G1`", context, reporter);
  else if ((single->role == CodeRole::DataSetting || single->role == CodeRole::CoordinateShift ||
            single->role == CodeRole::ReferenceReturn))
    reportRefused(*once, *motion, "both take the axis words of the block", context, reporter);
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto words = context.tree.wordsOf(block);
  const bool isNgc = context.dialect.behaviour.stopsAtStrayWords;
  if (words.size() < 2 || std::count_if(words.begin(), words.end(), isCode) < 2)
    return;
  if (isNgc)
    checkNgc(block, context, reporter);
  else
    reportTwoMeanings(block, context, reporter);
  std::array<const Word *, 256> ofGroup{};
  for (const Word &word : words) {
    const Code *code = isCode(word) ? codeOf(word, context.dialect) : nullptr;
    if (!code || code->group == 0 || maySupersede(*code, context.dialect))
      continue;
    const Word *&first = ofGroup[code->group];
    if (first && isNgc && first->tenths() == word.tenths())
      reportTwice(*first, word, context, reporter);
    else if (first && first->tenths() != word.tenths() && !isOfOtherSystem(*first, word, context.dialect))
      reportPair(*first, word, context, reporter);
    first = &word;
  }
}

} // namespace

extern const Rule conflictingGCodes;
const Rule conflictingGCodes{
    .info = {"conflicting-g-codes", Category::Word, Severity::Warning,
             "Reports two G codes in one block that exclude each other, such as two of one modal group."},
    .hooks = {.block = check}};

} // namespace feedhold::rules::conflicting_g_codes
