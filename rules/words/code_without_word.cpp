// code-without-word: `G4`, `G82 X10 R1 Z-4`, `M66 L3 Q2` where the control stops at a code that lacks a word.
#include "rules/motion/ngc_block.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <string_view>

namespace feedhold::rules::code_without_word {
namespace {

/// Whether the word of an earlier block counts while the code stays in force.
enum class Kept : std::uint8_t { No, WhileInForce };

/// What the interpreter asks of a code, as its messages name it.
struct Need {
  char address;
  std::uint16_t tenths;
  std::string_view letters; // all of them
  std::string_view way;
  Kept kept = Kept::No;
};
constexpr std::array kNeeds = {
    Need{'G', 40, "P", "write the seconds, as in `G4 P0.5`"},
    Need{'G', 50, "PQ", "write the second control point as P and Q"},
    Need{'G', 51, "IJ", "write the control point as I and J"},
    Need{'G', 100, "L", "write what is set: L1, L10 or L11 for a tool, L2 or L20 for a coordinate system"},
    Need{'G', 330, "K", "write the distance for each revolution as K"},
    Need{'G', 331, "K", "write the pitch as K"},
    Need{'G', 411, "D", "write the diameter of the tool as D"},
    Need{'G', 421, "D", "write the diameter of the tool as D"},
    Need{'G', 700, "Q", "write the label of the contour as Q"},
    Need{'G', 710, "Q", "write the label of the contour as Q"},
    Need{'G', 711, "Q", "write the label of the contour as Q"},
    Need{'G', 712, "Q", "write the label of the contour as Q"},
    Need{'G', 720, "Q", "write the label of the contour as Q"},
    Need{'G', 721, "Q", "write the label of the contour as Q"},
    Need{'G', 722, "Q", "write the label of the contour as Q"},
    Need{'G', 760, "PIJK", "write the pitch as P, the offset of the peak as I, the first cut as J, the depth as K"},
    Need{'G', 820, "P", "write the seconds at the bottom as P", Kept::WhileInForce},
    Need{'G', 860, "P", "write the seconds at the bottom as P", Kept::WhileInForce},
    Need{'G', 870, "IJK", "write the offsets as I and J, and the level as K", Kept::WhileInForce},
    Need{'G', 880, "P", "write the seconds at the bottom as P", Kept::WhileInForce},
    Need{'G', 890, "P", "write the seconds at the bottom as P", Kept::WhileInForce},
    Need{'G', 960, "S", "write the surface speed as S"},
    Need{'M', 610, "Q", "write the number of the tool as Q"},
    Need{'M', 620, "P", "write the number of the output as P"},
    Need{'M', 630, "P", "write the number of the output as P"},
    Need{'M', 640, "P", "write the number of the output as P"},
    Need{'M', 650, "P", "write the number of the output as P"},
    Need{'M', 670, "E", "write the number of the output as E"},
    Need{'M', 680, "E", "write the number of the output as E"},
};
/// They move only where an axis word says where to.
constexpr std::array<std::uint16_t, 22> kNeedAxes = {50,  51,  330, 331, 382, 383, 384, 385, 520, 730, 740,
                                                     760, 810, 820, 830, 840, 850, 860, 870, 880, 890, 920};

class CodeWithoutWord final : public FlowRule {
public:
  CodeWithoutWord(ProgramId program, const FileContext &context)
      : view_(program, context), isAsked_(context.dialect.behaviour.stopsAtStrayWords),
        isOperators_(startedBy(context, program) == StartedBy::Operator) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!isAsked_ || (!view_.mayHave(node, 'G') && !view_.mayHave(node, 'M')))
      return;
    const auto block = NgcBlock::of(view_, node);
    const std::optional<Lack> lack = block ? lackIn(*block, state) : std::nullopt;
    const auto [at, isNew] = places_.emplace(node, lack);
    if (!isNew && !lack)
      at->second = std::nullopt;
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, lack] : places_)
      if (lack)
        reporter.report(
            {.message = fmt::format("{} has no {}", context.quoted(lack->code->span()), lack->what),
             .span = lack->code->span(),
             .notes = {fmt::format("the control stops with an error: {} needs it", context.quoted(lack->code->span())),
                       std::string(lack->way)}});
  }

private:
  struct Lack {
    const Word *code;
    std::string what;
    std::string_view way;
  };

  std::optional<Lack> lackIn(const NgcBlock &block, const AbstractState &state) const {
    for (const Need &need : kNeeds) {
      const Word *code = block.code(need.address, {need.tenths});
      if (!code || (need.kept == Kept::WhileInForce && mayBeInForce(need.tenths, state)))
        continue;
      for (const char letter : need.letters)
        if (!block.find(letter))
          return Lack{code, fmt::format("`{}`", letter), need.way};
    }
    if (const Word *spline = block.code('G', {50}); spline && !block.find('I') != !block.find('J'))
      return Lack{spline, block.find('I') ? "`J`" : "`I`",
                  "write the first control point as I and J, or neither of them"};
    if (const auto lack = lackOfInput(block))
      return lack;
    return lackOfAxes(block);
  }
  /// The program before has ended, which takes G1 into force.
  bool mayBeInForce(std::uint16_t tenths, const AbstractState &state) const {
    if (isHavocked(state))
      return true;
    const auto motions = motionsInForce(view_, state);
    if (!motions)
      return !isOperators_ || view_.inForce(state, ModalKind::Motion)->codes() != 0;
    return std::ranges::find(*motions, tenths) != motions->end();
  }
  std::optional<Lack> lackOfInput(const NgcBlock &block) const {
    const Word *wait = block.code('M', {660});
    if (!wait)
      return std::nullopt;
    const Word *digital = block.find('P');
    const Word *kind = block.find('L');
    if (!digital && !block.find('E'))
      return Lack{wait, "`P` or `E`", "write a digital input as P, or an analogue one as E"};
    if (kind && kind->isNumber() && !kind->number().isZero() && digital && !block.find('Q'))
      return Lack{wait, "`Q`", "write the longest time to wait, in seconds, as Q"};
    return std::nullopt;
  }
  std::optional<Lack> lackOfAxes(const NgcBlock &block) const {
    if (block.namesAxes())
      return std::nullopt;
    if (const Word *code = block.code('G', kNeedAxes))
      return Lack{code, "axis word", "write the axes and their values in this block"};
    if (const Word *code = block.code('G', {432}); code && !block.find('H'))
      return Lack{code, "`H` and no axis word", "write the number of the tool as H, or the offset of each axis"};
    if (const Word *code = block.code('G', {530}); code && !block.motion())
      return Lack{code, "`G0` or `G1` and no axis word", "write the move, as in `G53 G0 Z0`"};
    const Word *data = block.code('G', {100});
    const Word *table = data ? block.find('L') : nullptr;
    const auto kind = table ? table->integer() : std::nullopt;
    const bool isTool = kind == 1 || kind == 10 || kind == 11;
    const bool isBare = std::ranges::none_of(std::string_view("RQIJ"), [&](char each) { return block.find(each); });
    if (isTool && isBare)
      return Lack{data, "value to set", "write the offsets as axis words, or the radius as R"};
    return std::nullopt;
  }

  MotionView view_;
  bool isAsked_;
  bool isOperators_;
  std::map<NodeId, std::optional<Lack>> places_; // on all paths
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CodeWithoutWord>(program, context);
}

} // namespace

extern const Rule codeWithoutWord;
const Rule codeWithoutWord{.info = {"code-without-word", Category::Word, Severity::Error,
                                    "Reports a code without a word that it needs, such as `G4` without `P`, where the "
                                    "control stops for that."},
                           .hooks = {.watch = watch}};

} // namespace feedhold::rules::code_without_word
