// feed-of-other-unit: `G01 X30. F0.2` and `G01 Z-40. F200` in one lathe program, and no code of the feed mode; `G98`
// and then `F0.2`.
#include "rules/motion/turning_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::feed_of_other_unit {
namespace {

/// Feeds that only fit one of the units: up to a millimetre in a revolution, or from 20 in a minute.
constexpr std::int64_t kMostPerRevolution = 1;
constexpr std::int64_t kLeastPerMinute = 20;
/// More than any tool of a lathe takes off in a revolution, where it goes into the part.
constexpr double kMostOfLathe = 5;
constexpr double kMostOfLatheInInches = 0.5;
/// Below the pitches of all taps, in millimetres and in inches, and above them.
constexpr double kNoPitch = 0.1;
constexpr double kNoPitchInInches = 0.004;
constexpr double kCoarsestPitch = 6.5;

const Word *feedModeIn(BlockId block, const FileContext &context) {
  return findAction(context.tree, block, context.dialect,
                    {CodeAction::FeedPerMinute, CodeAction::FeedPerRevolution, CodeAction::FeedInverse});
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
    if (feedModeIn(block, context))
      return std::nullopt;
    if (isThreadOrCall(block, context))
      continue;
    for (const Word &word : context.tree.wordsOf(block))
      if (word.address() == 'F' && word.isNumber() && !word.has(Word::kArgument))
        note(word, context, feeds);
  }
  return feeds.perRevolution && feeds.perMinute ? std::optional(feeds) : std::nullopt;
}

void checkMixed(ProgramId program, const FileContext &context, const Reporter &reporter) {
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

/// What the text of a program says of units, taken as a whole.
struct Units {
  bool isMetric = false; // G21 and no G20
  bool isInch = false;   // G20 and no G21
  bool isHigh = false;   // no G20, and heights that no machine has in inches
  bool hasMode = false;  // some code of the feed mode
  bool isMixed = false;  // another one than that of feed per minute
  bool isWhole = false;  // with its M30
  bool isOfMill = false; // it moves in Y, and starts no lathe's constant surface speed
};

/// `Z150.`: 4 m above the part.
bool isHighInInches(BlockId block, const FileContext &context) {
  constexpr std::int64_t kHigh = 100;
  const Word *z = findWord(context.tree, block, 'Z');
  return z && z->isNumber() && z->has(Word::kPoint) && z->number() >= Decimal(kHigh, 0) &&
         !meansOwnWords(context.tree, block, context.dialect);
}

Units unitsOf(ProgramId program, const FileContext &context) {
  Units units{.isOfMill = context.dialect.machine == MachineKind::Milling};
  bool hasMetric = false;
  bool hasInch = false;
  bool movesInY = false;
  const Program &whole = context.model.programs[program];
  for (BlockId block = whole.first; block < whole.last; block = block.next()) {
    const auto does = [&](CodeAction action) { return findAction(context.tree, block, context.dialect, {action}); };
    hasMetric = hasMetric || does(CodeAction::Metric);
    units.isHigh = units.isHigh || isHighInInches(block, context);
    hasInch = hasInch || does(CodeAction::Inch);
    units.hasMode = units.hasMode || feedModeIn(block, context);
    units.isMixed = units.isMixed || does(CodeAction::FeedPerRevolution) || does(CodeAction::FeedInverse);
    units.isWhole = units.isWhole || findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd);
    movesInY = movesInY || findWord(context.tree, block, 'Y');
    units.isOfMill = units.isOfMill && !does(CodeAction::ConstantSurface);
  }
  units.isMetric = hasMetric && !hasInch;
  units.isInch = hasInch && !hasMetric;
  units.isHigh = units.isHigh && !hasInch;
  units.isOfMill = units.isOfMill && movesInY;
  return units;
}

/// Goes through the text of a program with the feed mode that is in force.
class Walk {
public:
  Walk(ProgramId program, const FileContext &context)
      : context_(context), units_(unitsOf(program, context)), hidden_(program, context) {
    // A mill counts by the minute until something else is said.
    isPerMinute_ = units_.isOfMill && units_.isMetric && !units_.hasMode;
  }

  void read(BlockId block, const Reporter &reporter) {
    const bool isHidden = isHiddenIn(block);
    noteSpeed(block);
    if (isHidden && units_.hasMode)
      lose();
    if (const Word *mode = feedModeIn(block, context_)) {
      const CodeAction action = codeOf(*mode, context_.dialect)->action;
      mode_ = mode;
      isPerMinute_ = action == CodeAction::FeedPerMinute;
      isPerRevolution_ = action == CodeAction::FeedPerRevolution;
    }
    if (isHidden || (meansOwnWords(context_.tree, block, context_.dialect) && !isDrilling(block)))
      return;
    if (findAction(context_.tree, block, context_.dialect, {CodeAction::CycleTap, CodeAction::CycleTapLeft}))
      judgeTap(block, reporter);
    if (isThread(block) && !isDrilling(block))
      return;
    for (const Word &word : context_.tree.wordsOf(block))
      if (word.address() == 'F' && word.isNumber())
        judgeFeed(word, block, reporter);
  }

private:
  /// Jumps and calls within a program that always feeds by the minute change nothing about that.
  bool isHiddenIn(BlockId block) const {
    const auto calls = context_.model.callsIn(block, block.next());
    const Block &its = context_.tree.blocks[block];
    const bool isOwn = !units_.isMixed && !its.has(Block::kSkip) && !its.has(Block::kSkipInside) &&
                       !its.has(Block::kBroken) &&
                       std::ranges::all_of(calls, [](const Call &call) { return call.kind == CallKind::Local; });
    return !isOwn && hidden_.isIn(block);
  }
  void lose() {
    mode_ = nullptr;
    isPerMinute_ = isPerRevolution_ = false;
  }
  bool isThread(BlockId block) const {
    return findAction(context_.tree, block, context_.dialect,
                      {CodeAction::Thread, CodeAction::CycleTap, CodeAction::CycleTapLeft, CodeAction::OtherCycle}) ||
           findTurningCycle(context_.tree, block, context_.dialect) ||
           (!units_.isOfMill && findCode(context_.tree, block, context_.dialect, CodeRole::CannedCycle));
  }
  /// Of a lathe, by a cycle; the F of a tap is its pitch.
  bool isDrilling(BlockId block) const {
    return context_.dialect.machine == MachineKind::Turning &&
           std::ranges::any_of(context_.tree.wordsOf(block),
                               [&](const Word &word) { return word.integer() != 84U && drillsAlongZ(word, context_); });
  }
  /// So slow that it would take a minute for a millimetre, or for some hundredths of an inch.
  bool isCreep(const Decimal &feed) const {
    return !feed.isZero() && !feed.isNegative() &&
           feed < (units_.isMetric || (mode_ && units_.isHigh) ? Decimal(1, 0) : Decimal(5, 2));
  }
  /// Without a point, a number is what it looks like only beside feeds that have one.
  void judgeFeed(const Word &word, BlockId block, const Reporter &reporter) {
    if (word.has(Word::kPoint))
      judge(word, reporter);
    const bool isOfLathe = isPerRevolution_ && context_.dialect.machine == MachineKind::Turning;
    if (isOfLathe && goesIn(block) && (word.has(Word::kPoint) || (hasSmallFeed_ && isLarge(word))))
      judgeOfLathe(word, reporter);
    hasSmallFeed_ = hasSmallFeed_ || (word.has(Word::kPoint) && word.number() <= Decimal(kMostPerRevolution, 0));
  }
  static bool isLarge(const Word &word) { return word.number() >= Decimal(kLeastPerMinute, 0); }
  /// Back at feed, the tool may be fast.
  bool goesIn(BlockId block) const {
    const Word *depth = findWord(context_.tree, block, 'Z');
    return depth && depth->isNumber() && depth->number().isNegative();
  }
  void judgeOfLathe(const Word &word, const Reporter &reporter) {
    if (!told_ && word.number().toDouble() >= (units_.isInch ? kMostOfLatheInInches : kMostOfLathe))
      tell(word, "per revolution", "by its size this is a feed per minute: the tool runs into the part", reporter);
  }
  void judge(const Word &word, const Reporter &reporter) {
    if (told_)
      return;
    const Decimal &feed = word.number();
    if (isPerMinute_ && isCreep(feed))
      tell(word, "per minute", "the tool creeps: by its size this is a feed per revolution", reporter);
    else if (isPerRevolution_ && feed >= Decimal(kLeastPerMinute, 0))
      tell(word, "per revolution", "by its size this is a feed per minute: the tool runs into the part", reporter);
  }
  /// The pitch of a tap where its feed belongs.  `,R1` stands for a cycle of other makers, whose F is the pitch.
  void judgeTap(BlockId block, const Reporter &reporter) {
    const Word *feed = findWord(context_.tree, block, 'F');
    const auto words = context_.tree.wordsOf(block);
    if (told_ || (!mode_ && !isWholeWithoutMode()) || !feed || !feed->isNumber() || feed->number().isZero() ||
        std::ranges::any_of(words, [](const Word &word) { return word.has(Word::kComma); }))
      return;
    if (isPerRevolution_ && feed->number() >= Decimal(kLeastPerMinute, 0))
      tell(*feed, "per revolution", "no tap has that pitch: by its size this is a feed per minute", reporter);
    else if (const double moved = feed->number().toDouble();
             (mode_ && isPerMinute_ && feed->has(Word::kPoint) && isBelowPitches(moved)) ||
             (!mode_ && moved > kCoarsestPitch && isBelowPitches(moved)))
      tell(*feed, "per minute", "the tap does not follow its thread: by its size this is a pitch, as with `G95`",
           reporter);
  }
  bool isBelowPitches(double feed) const {
    return speed_ && feed < *speed_ * (units_.isMetric ? kNoPitch : kNoPitchInInches);
  }
  /// Then the unit is that of power on: a number that fits neither of them is wrong.
  bool isWholeWithoutMode() const {
    return !units_.hasMode && units_.isWhole && context_.dialect.machine == MachineKind::Milling;
  }
  void noteSpeed(BlockId block) {
    const Word *speed = findWord(context_.tree, block, 'S');
    if (speed)
      speed_ = speed->isNumber() ? std::optional(speed->number().toDouble()) : std::nullopt;
  }
  void tell(const Word &word, std::string_view unit, std::string note, const Reporter &reporter) {
    told_ = true;
    Diagnostic diagnostic{.message = fmt::format("{} is counted {}", context_.quoted(word.span()), unit),
                          .span = word.span(),
                          .notes = {std::move(note), "correct the number, or write the code of its unit"}};
    if (mode_)
      diagnostic.labels.push_back({mode_->span(), fmt::format("feeds are {} from here", unit)});
    reporter.report(std::move(diagnostic));
  }

  const FileContext &context_;
  Units units_;
  HiddenWork hidden_;
  const Word *mode_ = nullptr; // its code, where the program has one
  std::optional<double> speed_;
  bool isPerMinute_ = false;
  bool isPerRevolution_ = false;
  bool hasSmallFeed_ = false;
  bool told_ = false;
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine == MachineKind::Turning)
    checkMixed(program, context, reporter);
  Walk walk(program, context);
  const Program &whole = context.model.programs[program];
  for (BlockId block = whole.first; block < whole.last; block = block.next())
    walk.read(block, reporter);
}

} // namespace

extern const Rule feedOfOtherUnit;
const Rule feedOfOtherUnit{
    .info = {"feed-of-other-unit", Category::Motion, Severity::Warning,
             "Reports a feed that by its size is counted in another unit than the one in force: per minute, or per "
             "revolution."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::feed_of_other_unit
