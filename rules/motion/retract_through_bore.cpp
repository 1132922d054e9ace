// retract-through-bore: `T0303 (BORING BAR)`, `G01 X46. Z-42.`, and `G00 X50.`: out through the wall of the bore.
#include "rules/comments/remarks_of_block.h"
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

namespace feedhold::rules::retract_through_bore {
namespace {

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), walk_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    if (const Word *tool = findWord(context_.tree, block, 'T')) {
      bar_ = speaksOfBoringBar(remarksOf(context_, block)) ? tool : nullptr;
      cut_ = nullptr;
    }
    const TurningPoint before = walk_.at();
    const TurningMove move = walk_.read(block);
    const TurningPoint &at = walk_.at();
    const bool isKnown = before.x && before.z && at.x && at.z;
    if (bar_ && cut_ && move == TurningMove::Rapid && isKnown && *at.x > *before.x && *before.x > 0)
      tell(block, before, at, reporter);
    if (move == TurningMove::Feed)
      cut_ = isKnown && *at.x == *before.x && *at.z < *before.z && *at.z < 0 ? &context_.tree.blocks[block] : nullptr;
    else if (move != TurningMove::None || !at.x || !at.z)
      cut_ = nullptr;
  }

private:
  void tell(BlockId block, const TurningPoint &from, const TurningPoint &to, const Reporter &reporter) {
    const Word *word = findWord(context_.tree, block, 'X');
    word = word ? word : findWord(context_.tree, block, 'U');
    if (!word)
      return;
    reporter.report({.message = fmt::format("the boring bar leaves the bore outwards at rapid, from X{:g} to X{:g}",
                                            *from.x, *to.x),
                     .span = word->span(),
                     .labels = {{cut_->span(), fmt::format("cut down to Z{:g}", *from.z)}, {bar_->span(), "the tool"}},
                     .notes = {"the tool is at the bottom of the bore, and goes through its wall at rapid",
                               "go towards the centre first, then out along Z, and only then to the next diameter"}});
  }

  const FileContext &context_;
  TurningWalk walk_;
  const Word *bar_ = nullptr;  // the tool, if its remark calls it a boring bar
  const Block *cut_ = nullptr; // the last move, along the bore
};

} // namespace

extern const Rule retractThroughBore;
const Rule retractThroughBore{.info = {"retract-through-bore", Category::Motion, Severity::Warning,
                                       "Reports a boring bar of a lathe, called so by the remark of its T word, that "
                                       "leaves the bottom of the bore outwards at rapid."},
                              .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::retract_through_bore
