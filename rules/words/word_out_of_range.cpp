// word-out-of-range: `F-100`, `M19 R400`, `G2 X20 I10 P0` where the control stops at a value that it does not take.
#include "rules/motion/ngc_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace feedhold::rules::word_out_of_range {
namespace {

constexpr double kNearWhole = 1e-4; // as the interpreter takes a number for a whole one
enum class Test : std::uint8_t { Below, AtMost, Above, Zero, NotWhole };

/// A value that the control refuses.
struct Bound {
  char letter;
  Test test;
  double bound;
  std::string_view accepted;
  char address = 0; // of the codes beside which it is refused; 0: in every block
  std::span<const std::uint16_t> codes = {};
};
constexpr std::array<std::uint16_t, 2> kArcs = {20, 30};
constexpr std::array<std::uint16_t, 2> kSides = {410, 420};
constexpr std::array<std::uint16_t, 1> kData = {100};
constexpr std::array<std::uint16_t, 1> kThreads = {760};
constexpr std::array<std::uint16_t, 11> kCycles = {730, 740, 810, 820, 830, 840, 850, 860, 870, 880, 890};
constexpr std::array<std::uint16_t, 1> kOrients = {190};
constexpr std::array<std::uint16_t, 1> kSetsTool = {610};
constexpr std::array<std::uint16_t, 2> kAnalogue = {670, 680};
constexpr std::array kBounds = {
    Bound{'F', Test::Below, 0, "a feed is not negative"},
    Bound{'S', Test::Below, 0, "a speed is not negative: `M4` turns the other way"},
    Bound{'T', Test::Below, 0, "no tool has a negative number"},
    Bound{'H', Test::Below, 0, "no tool has a negative number"},
    Bound{'L', Test::Below, 0, "L is not negative"},
    Bound{'T', Test::NotWhole, kNearWhole, "T is a whole number"},
    Bound{'H', Test::NotWhole, kNearWhole, "H is a whole number"},
    Bound{'L', Test::NotWhole, kNearWhole, "L is a whole number"},
    Bound{'P', Test::NotWhole, 0.001, "P is a whole number of turns", 'G', kArcs},
    Bound{'P', Test::Below, 0.5, "P counts the turns, from 1", 'G', kArcs},
    Bound{'D', Test::NotWhole, kNearWhole, "D is the number of a tool: a diameter stands beside `G41.1` or `G42.1`",
          'G', kSides},
    Bound{'D', Test::Below, 0, "no tool has a negative number", 'G', kSides},
    Bound{'Q', Test::NotWhole, kNearWhole, "the orientation of a tool is a whole number", 'G', kData},
    Bound{'Q', Test::Above, 9, "the orientation of a tool is 0 to 9", 'G', kData},
    Bound{'I', Test::Zero, 0, "I is the offset of the peak, and not 0", 'G', kThreads},
    Bound{'J', Test::AtMost, 0, "J is the depth of the first cut, above 0", 'G', kThreads},
    Bound{'K', Test::AtMost, 0, "K is the full depth, above J", 'G', kThreads},
    Bound{'L', Test::Zero, 0, "a cycle is made at least once", 'G', kCycles},
    Bound{'P', Test::NotWhole, 0.001, "P is 0, 1 or 2", 'M', kOrients},
    Bound{'P', Test::Below, -0.5, "P is 0, 1 or 2", 'M', kOrients},
    Bound{'P', Test::Above, 2.5, "P is 0, 1 or 2", 'M', kOrients},
    Bound{'R', Test::Below, 0, "R is 0 to 360 degrees", 'M', kOrients},
    Bound{'R', Test::Above, 360, "R is 0 to 360 degrees", 'M', kOrients},
    Bound{'Q', Test::AtMost, 0, "Q is the longest time to wait, above 0", 'M', kOrients},
    Bound{'Q', Test::Below, 0, "no tool has a negative number", 'M', kSetsTool},
    Bound{'E', Test::Below, 0, "outputs count from 0", 'M', kAnalogue},
};

struct Range {
  double lo;
  double hi;
};

bool refuses(const Bound &bound, const Range &value) {
  switch (bound.test) {
  case Test::Below: return value.hi < bound.bound;
  case Test::AtMost: return value.hi <= bound.bound;
  case Test::Above: return value.lo > bound.bound;
  case Test::Zero: return value.lo == 0 && value.hi == 0;
  case Test::NotWhole: return value.lo == value.hi && std::abs(value.lo - std::round(value.lo)) > bound.bound;
  }
  return false;
}

class Checker {
public:
  Checker(const FlowFacts &facts, const FileContext &context, const Reporter &reporter)
      : facts_(facts), context_(context), reporter_(reporter), view_(facts.program, context) {}

  void check(NodeId node) const {
    const auto block = NgcBlock::of(view_, node);
    if (!block)
      return;
    for (const Word *word : block->words())
      for (const Bound &bound : kBounds)
        if (word->address() == bound.letter && (bound.address == 0 || block->code(bound.address, bound.codes)) &&
            isRefused(bound, *word)) {
          tell(*word, bound.accepted);
          break;
        }
    checkData(*block);
    checkThread(*block);
    checkInput(*block);
  }

private:
  /// Of all runs that come to the word; absent where not everything about it is known.
  std::optional<Range> rangeOf(const Word &word) const {
    if (word.isNumber())
      return Range{word.number().toDouble(), word.number().toDouble()};
    const AbstractValue *value = word.form() == WordForm::Expression ? facts_.valueOf(word.expression()) : nullptr;
    if (!value || !value->isNumber())
      return std::nullopt;
    const auto &interval = value->number().interval();
    return Range{interval.lo, interval.hi};
  }
  bool isRefused(const Bound &bound, const Word &word) const {
    const auto range = rangeOf(word);
    return range && refuses(bound, *range);
  }
  void tell(const Word &word, std::string_view accepted) const {
    reporter_.report(
        {.message = fmt::format("the control does not take {}: {}", context_.quoted(word.span()), accepted),
         .span = word.span(),
         .notes = {"the control stops with an error", "correct the value"}});
  }
  /// `G10 L3`
  void checkData(const NgcBlock &block) const {
    const Word *kind = block.code('G', kData) ? block.find('L') : nullptr;
    const auto number = kind ? kind->integer() : std::nullopt;
    constexpr std::array<std::uint32_t, 6> kKinds = {0, 1, 2, 10, 11, 20};
    if (number && std::ranges::find(kKinds, *number) == kKinds.end())
      tell(*kind, "`G10` has L1, L10 and L11 for tools, L2 and L20 for coordinate systems");
  }
  /// The first cut of G76 is not as deep as the thread.
  void checkThread(const NgcBlock &block) const {
    const Word *first = block.code('G', kThreads) ? block.find('J') : nullptr;
    const Word *depth = first ? block.find('K') : nullptr;
    const auto cut = first ? rangeOf(*first) : std::nullopt;
    const auto full = depth ? rangeOf(*depth) : std::nullopt;
    if (cut && full && full->hi <= cut->lo && full->lo > 0 && cut->lo > 0)
      tell(*depth, fmt::format("K is the full depth, above {}", context_.quoted(first->span())));
  }
  /// M66 that waits needs a time, and an analogue input cannot be waited for.
  void checkInput(const NgcBlock &block) const {
    const Word *kind = block.code('M', {660}) ? block.find('L') : nullptr;
    const auto range = kind ? rangeOf(*kind) : std::nullopt;
    if (!range || range->lo <= 0)
      return;
    const Word *analogue = block.find('E');
    const Word *longest = block.find('Q');
    const auto time = longest ? rangeOf(*longest) : std::nullopt;
    if (analogue && !block.find('P'))
      tell(*kind, fmt::format("an analogue input ({}) is read at once, with L0", context_.quoted(analogue->span())));
    else if (time && time->hi <= 0)
      tell(*longest, "Q is the longest time to wait, above 0");
  }

  const FlowFacts &facts_;
  const FileContext &context_;
  const Reporter &reporter_;
  MotionView view_;
};

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.behaviour.stopsAtStrayWords)
    return;
  const Checker checker(facts, context, reporter);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    if (facts.isReached(node))
      checker.check(node);
}

/// `G154`, `M-8`, `M3.5`, `N-10`: no table of the control has room for it.
void checkNumber(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.behaviour.stopsAtStrayWords || !word.isNumber() || word.has(Word::kArgument) ||
      context.tree.blocks[block].has(Block::kBroken))
    return;
  const double value = word.number().toDouble();
  const auto tell = [&](std::string_view accepted) {
    reporter.report({.message = fmt::format("the control does not take {}: {}", context.quoted(word.span()), accepted),
                     .span = word.span(),
                     .notes = {"the control stops with an error", "correct the number"}});
  };
  if (word.address() == 'G' && (value < 0 || value >= 100))
    tell("G codes go from G0 to G99.9");
  else if (word.address() == 'M' && value < 0)
    tell("M codes begin with M0");
  else if (word.address() == 'M' && std::abs(value - std::round(value)) > kNearWhole)
    tell("M codes are whole numbers");
  else if (word.address() == 'N' && value < 0)
    tell("a line number has no sign");
}

} // namespace

extern const Rule wordOutOfRange;
const Rule wordOutOfRange{.info = {"word-out-of-range", Category::Word, Severity::Error,
                                   "Reports a value that the control does not take, such as `F-100` or `M19 R400`, "
                                   "where it stops for that."},
                          .hooks = {.word = checkNumber, .wordAddresses = "GMN", .flow = check}};

} // namespace feedhold::rules::word_out_of_range
