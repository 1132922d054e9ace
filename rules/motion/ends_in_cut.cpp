// ends-in-cut: `G01 X0. F.08`, and `M30`: the tool stays in the part.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feedhold::rules::ends_in_cut {
namespace {

class Reader {
public:
  Reader(ProgramId program, const FileContext &context)
      : context_(context), walk_(program, context), hidden_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    if (findCode(context_.tree, block, context_.dialect, CodeRole::ProgramEnd) && cut_ && !hidden_.isIn(block))
      tell(block, reporter);
    const TurningMove move = walk_.read(block);
    const TurningPoint &at = walk_.at();
    if (move == TurningMove::Feed && at.x && at.z && *at.z < 0) {
      reach_ = std::max(reach_, std::abs(*at.x));
      cut_ = isInside() ? &context_.tree.blocks[block] : nullptr;
    } else if (move != TurningMove::None || !at.x || !at.z || mayMoveUnseen(block)) {
      cut_ = nullptr;
    }
  }

private:
  /// Not beyond the largest diameter to which a cut below the face has come, which may be a way out at feed.
  bool isInside() const { return std::abs(*walk_.at().x) < reach_ || *walk_.at().x == 0; }
  /// A return, a call, or a code of the machine's builder.
  bool mayMoveUnseen(BlockId block) const {
    return hidden_.isIn(block) || std::ranges::any_of(context_.tree.wordsOf(block), [&](const Word &word) {
             const Code *code = word.isCode() ? codeOf(word, context_.dialect) : nullptr;
             return word.address() == 'T' || (word.isCode() && !code) ||
                    (code && (code->role == CodeRole::ReferenceReturn || code->role == CodeRole::MachinePosition ||
                              code->action == CodeAction::Unmodelled || code->action == CodeAction::Anything));
           });
  }
  void tell(BlockId block, const Reporter &reporter) {
    const TurningPoint &at = walk_.at();
    reporter.report({.message = fmt::format("the program ends with the tool in the part, at X{:g} Z{:g}", *at.x, *at.z),
                     .span = context_.tree.blocks[block].span(),
                     .labels = {{cut_->span(), "the last move"}},
                     .notes = {"no block takes the tool out: the next start, or the turret, drives it through the part",
                               "retract in front of the end, by `G00` and by `G28 U0 W0`"}});
    cut_ = nullptr;
  }

  const FileContext &context_;
  TurningWalk walk_;
  HiddenWork hidden_;
  const Block *cut_ = nullptr; // the last move, below the face
  double reach_ = 0;
};

} // namespace

extern const Rule endsInCut;
const Rule endsInCut{.info = {"ends-in-cut", Category::Motion, Severity::Warning,
                              "Reports a program of a lathe that ends with the tool where its last cut has led it, "
                              "below the face of the part."},
                     .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::ends_in_cut
