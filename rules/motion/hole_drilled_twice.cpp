// hole-drilled-twice: `X10. Y20.` again in the list of holes of one tool.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <tuple>

namespace feedhold::rules::hole_drilled_twice {
namespace {

constexpr std::array kDrilling = {CodeAction::CycleDrill,     CodeAction::CycleDwell,    CodeAction::CyclePeck,
                                  CodeAction::CycleChipBreak, CodeAction::CycleTap,      CodeAction::CycleTapLeft,
                                  CodeAction::CycleBore,      CodeAction::CycleBoreStop, CodeAction::CycleBoreDwell,
                                  CodeAction::CycleFineBore};
constexpr std::array kKeepHoles = {CodeAction::ReturnToInitial, CodeAction::ReturnToR, CodeAction::LengthPlus};
constexpr std::array kOtherMoves = {CodeAction::CycleOff, CodeAction::Rapid, CodeAction::Linear};

bool isOneOf(CodeAction action, std::span<const CodeAction> actions) {
  return std::ranges::find(actions, action) != actions.end();
}

/// X, Y, depth and R level; absent where they are not numbers.
using Level = std::optional<Decimal>;
using Hole = std::tuple<Decimal, Decimal, Decimal, Decimal, CodeAction>;

/// Follows the holes of one tool in one coordinate system.
class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), hidden_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    if (hidden_.isIn(block) || !context_.tree.statementsOf(block).empty() || find(block, 'T'))
      return forget();
    bool starts = false;
    for (const Word &word : context_.tree.wordsOf(block))
      starts = readCode(word) || starts;
    const bool goes = follow(block, 'X', place_[0]) | follow(block, 'Y', place_[1]);
    if (!cycle_)
      return;
    follow(block, 'Z', place_[2]);
    follow(block, 'R', place_[3]);
    const bool drills = goes || (starts && !context_.dialect.behaviour.cyclesNeedXY);
    if (drills && !isLeftOut(block) && std::ranges::all_of(place_, &Level::has_value))
      note(block, reporter);
  }

private:
  const Word *find(BlockId block, char address) const { return findWord(context_.tree, block, address); }

  void forget() {
    cycle_.reset();
    place_ = {};
    holes_.clear();
  }
  /// Whether a cycle begins.
  bool readCode(const Word &word) {
    if (word.address() != 'G')
      return false;
    const Code *code = codeOf(word, context_.dialect);
    if (code && code->action == CodeAction::Incremental) {
      isIncremental_ = true;
    } else if (code && code->action == CodeAction::Absolute) {
      isIncremental_ = false;
    } else if (code && isOneOf(code->action, kDrilling)) {
      cycle_ = code->action;
      place_[2].reset();
      place_[3].reset();
      return true;
    } else if (code && isOneOf(code->action, kOtherMoves)) {
      cycle_.reset();
    } else if (!code || !isOneOf(code->action, kKeepHoles)) {
      forget();
    }
    return false;
  }
  /// Whether the block has the word.
  bool follow(BlockId block, char address, Level &level) const {
    const Word *word = find(block, address);
    if (word)
      level = word->isNumber() && !isIncremental_ ? Level(word->number()) : std::nullopt;
    return word != nullptr;
  }
  /// `L0`, `K0`: the cycle is set, and no hole is made.
  bool isLeftOut(BlockId block) const {
    return std::ranges::any_of(context_.tree.wordsOf(block), [](const Word &word) {
      return (word.address() == 'L' || word.address() == 'K') && !(word.isNumber() && !word.number().isZero());
    });
  }
  void note(BlockId block, const Reporter &reporter) {
    const Span span = context_.tree.blocks[block].span();
    const auto [known, isNew] = holes_.try_emplace(Hole{*place_[0], *place_[1], *place_[2], *place_[3], *cycle_}, span);
    if (isNew)
      return;
    reporter.report({.message = fmt::format("{} makes a hole that this tool has made before, to the same depth",
                                            context_.quoted(span)),
                     .span = span,
                     .labels = {{known->second, "at the same place"}},
                     .notes = {"the tool goes into a finished hole, and another hole may be missing in its stead",
                               "correct the position, or delete the block"}});
  }

  const FileContext &context_;
  HiddenWork hidden_;
  std::optional<CodeAction> cycle_;
  bool isIncremental_ = false;
  std::array<Level, 4> place_; // X, Y, Z, R
  std::map<Hole, Span> holes_;
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling)
    return;
  Reader reader(program, context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    reader.read(block, reporter);
}

} // namespace

extern const Rule holeDrilledTwice;
const Rule holeDrilledTwice{.info = {"hole-drilled-twice", Category::Motion, Severity::Warning,
                                     "Reports a hole that a tool drills twice, to the same depth."},
                            .hooks = {.program = check}};

} // namespace feedhold::rules::hole_drilled_twice
