// tool-without-cut: `T0202 (FINISHING)`, `G00 X30. Z2.`, and the turret turns on: the cut is missing.
#include "rules/comments/remarks_of_block.h"
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <optional>

namespace feedhold::rules::tool_without_cut {
namespace {

/// Tools that do their work without a cut: they stop, pull or measure.
bool speaksOfOtherWork(std::string_view remark) {
  return saysAny(remark,
                 {"STOP", "PULL", "PROBE", "TOUCH", "ANSCHLAG", "TOPE", "CHECK", "MEAS", "INDEX", "TRANSFER", "BUTEE"});
}

/// `T0202`, `T2`: with the number of its offset.  Null: `T0200` may cancel one.
const Word *toolIn(const FileContext &context, BlockId block) {
  const Word *word = findWord(context.tree, block, 'T');
  return word && !word->has(Word::kArgument) ? word : nullptr;
}

class Reader {
public:
  Reader(ProgramId program, const FileContext &context)
      : context_(context), walk_(program, context), hidden_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    const Word *tool = toolIn(context_, block);
    const bool ends = findCode(context_.tree, block, context_.dialect, CodeRole::ProgramEnd);
    if (tool || ends) {
      finish(reporter);
      tool_ = tool && isCall(*tool) ? tool : nullptr;
      section_ = {};
    }
    const TurningPoint before = walk_.at();
    const TurningMove move = walk_.read(block);
    note(block, move, before);
  }

private:
  struct Section {
    bool starts = false;    // the spindle turns for it
    bool positions = false; // at rapid, in X and Z
    bool mayWork = false;
  };

  static bool isCall(const Word &word) {
    const auto number = word.integer();
    return number && *number != 0 && (*number < 100 || *number % 100 != 0);
  }
  void note(BlockId block, TurningMove move, const TurningPoint &before) {
    const auto does = [&](std::initializer_list<CodeAction> actions) {
      return findAction(context_.tree, block, context_.dialect, actions) != nullptr;
    };
    section_.starts = section_.starts || does({CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise,
                                               CodeAction::ConstantSurface, CodeAction::ConstantSpeed});
    const TurningPoint &at = walk_.at();
    const bool isKnown = before.x && before.z && at.x && at.z;
    const bool stands = isKnown && *before.x == *at.x && *before.z == *at.z;
    section_.positions = section_.positions || (move == TurningMove::Rapid && at.x && at.z);
    section_.mayWork = section_.mayWork || move == TurningMove::Cycle || move == TurningMove::Unknown ||
                       (move == TurningMove::Feed && !stands) || walk_.isInContour(block) || hidden_.isIn(block) ||
                       mayMoveUnseen(block) || speaksOfOtherWork(remarksOf(context_, block));
  }
  /// A stop for the operator, a code of the machine's builder, or one that moves in a way of its own.
  bool mayMoveUnseen(BlockId block) const {
    return !context_.tree.statementsOf(block).empty() ||
           findCode(context_.tree, block, context_.dialect, CodeRole::ProgramStop) ||
           findCode(context_.tree, block, context_.dialect, CodeRole::Return) ||
           std::ranges::any_of(context_.tree.wordsOf(block), [&](const Word &word) {
             const Code *code = word.isCode() ? codeOf(word, context_.dialect) : nullptr;
             return word.isCode() &&
                    (!code || code->action == CodeAction::Unmodelled || code->action == CodeAction::Anything ||
                     code->action == CodeAction::OtherCycle || isCirclePocket(code->action) || isSkip(code->role));
           });
  }
  void finish(const Reporter &reporter) const {
    if (!tool_ || !section_.starts || !section_.positions || section_.mayWork)
      return;
    reporter.report(
        {.message = fmt::format("{} is called and positioned, but cuts nothing", context_.quoted(tool_->span())),
         .span = tool_->span(),
         .notes = {"up to the next tool, or the end, no block moves it at feed: the operation is missing",
                   "write the cut, such as `G70` for a finishing tool, or take the tool out"}});
  }

  const FileContext &context_;
  TurningWalk walk_;
  HiddenWork hidden_;
  const Word *tool_ = nullptr;
  Section section_;
};

} // namespace

extern const Rule toolWithoutCut;
const Rule toolWithoutCut{.info = {"tool-without-cut", Category::Motion, Severity::Warning,
                                   "Reports a tool of a lathe that is called and positioned, and cuts nothing before "
                                   "the next one."},
                          .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::tool_without_cut
