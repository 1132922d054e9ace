// finishing-of-other-contour: `G72 P3 Q4` roughs a second contour, and `G70 P1 Q2` finishes the first one once more.
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::finishing_of_other_contour {
namespace {

bool isFinishing(const Contour &contour, const FileContext &context) {
  return findAction(context.tree, contour.cycle->block, context.dialect, {CodeAction::FinishContour}) != nullptr;
}

bool isSame(const Contour &a, const Contour &b) { return a.first == b.first && a.last == b.last; }

/// U or W beside P and Q, other than 0.
bool leavesAllowance(BlockId block, const FileContext &context) {
  return std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
    const bool isAllowance = word.address() == 'U' || word.address() == 'W';
    return isAllowance && (!word.isNumber() || !word.number().isZero());
  });
}

class Cycles {
public:
  Cycles(ProgramId program, const FileContext &context) : context_(context), contours_(contoursOf(program, context)) {}

  void check(const Reporter &reporter) const {
    for (const Contour &contour : contours_) {
      if (!isFinishing(contour, context_))
        continue;
      if (const Contour *longer = roughedToOtherEnd(contour))
        tellEnd(contour, *longer, reporter);
      else if (const Contour *left = leftUnfinished(contour))
        tellLeft(contour, *left, reporter);
    }
  }

private:
  /// The roughing cycle with the same first block, where none has the same last one, and no other cycle finishes to its
  /// end: a contour may be finished in two parts.
  const Contour *roughedToOtherEnd(const Contour &finished) const {
    const Contour *other = nullptr;
    for (const Contour &contour : contours_) {
      if (isFinishing(contour, context_) || contour.first != finished.first)
        continue;
      if (contour.last == finished.last)
        return nullptr;
      other = &contour;
    }
    const bool isInParts = other && std::ranges::any_of(contours_, [&](const Contour &contour) {
                             return isFinishing(contour, context_) && contour.last == other->last;
                           });
    return isInParts ? nullptr : other;
  }

  /// The contour roughed last, which no cycle finishes, where this one finishes another contour for the second time.
  const Contour *leftUnfinished(const Contour &again) const {
    const Contour *roughed = nullptr;
    bool isSecond = false;
    for (const Contour &contour : contours_) {
      if (contour.cycle->block >= again.cycle->block)
        continue;
      if (!isFinishing(contour, context_))
        roughed = roughed && roughed->cycle->block > contour.cycle->block ? roughed : &contour;
      else
        isSecond = isSecond || isSame(contour, again);
    }
    if (!isSecond || !roughed || isSame(*roughed, again) || !leavesAllowance(roughed->cycle->block, context_))
      return nullptr;
    const bool isFinished = std::ranges::any_of(contours_, [&](const Contour &contour) {
      return isFinishing(contour, context_) && contour.first == roughed->first;
    });
    return isFinished ? nullptr : roughed;
  }

  BlockId contentBehind(BlockId block) const {
    do
      block = block.next();
    while (!hasContent(context_, block));
    return block;
  }
  Span cycleOf(const Contour &contour) const { return context_.tree.blocks[contour.cycle->block].span(); }
  std::string numbersOf(const Contour &contour) const {
    const Word *last = findWord(context_.tree, contour.cycle->block, 'Q');
    return fmt::format("`{} {}`", context_.text(contour.cycle->targetSpan),
                       last ? context_.text(last->span()) : std::string_view());
  }
  Span codeOf(const Contour &contour) const {
    return findCode(context_.tree, contour.cycle->block, context_.dialect, CodeRole::Contour)->span();
  }

  void tellEnd(const Contour &finished, const Contour &roughed, const Reporter &reporter) const {
    const Word *end = findWord(context_.tree, finished.cycle->block, 'Q');
    const Word *other = findWord(context_.tree, roughed.cycle->block, 'Q');
    if (!end || !other)
      return;
    const bool isLonger = finished.last > roughed.last;
    const auto lineOf = [&](BlockId block) { return context_.source.lineOf(context_.tree.blocks[block].begin); };
    reporter.report(
        {.message = fmt::format("{} finishes to {}, and {} roughed the contour to {}",
                                context_.quoted(codeOf(finished)), context_.quoted(end->span()),
                                context_.quoted(codeOf(roughed)), context_.quoted(other->span())),
         .span = end->span(),
         .labels = {{other->span(), "the end of the roughed contour"}},
         .notes = {isLonger ? fmt::format("the finishing cut takes in line {}, which was not roughed, at the feed of "
                                          "finishing",
                                          lineOf(contentBehind(roughed.last)))
                            : fmt::format("the finishing cut ends at line {}: the rest of the contour keeps its "
                                          "allowance",
                                          lineOf(finished.last)),
                   "give both cycles the same P and Q"}});
  }

  void tellLeft(const Contour &again, const Contour &left, const Reporter &reporter) const {
    reporter.report(
        {.message = fmt::format("{} finishes {} once more, and no cycle finishes the contour that {} roughed",
                                context_.quoted(codeOf(again)), numbersOf(again), context_.quoted(codeOf(left))),
         .span = cycleOf(again),
         .labels = {{cycleOf(left), "roughed, and never finished"}},
         .notes = {"the contour in between keeps its finishing allowance",
                   fmt::format("write {} in this block", numbersOf(left))}});
  }

  const FileContext &context_;
  std::vector<Contour> contours_;
};

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine == MachineKind::Turning)
    Cycles(program, context).check(reporter);
}

} // namespace

extern const Rule finishingOfOtherContour;
const Rule finishingOfOtherContour{
    .info = {"finishing-of-other-contour", Category::Structure, Severity::Warning,
             "Reports a `G70` that finishes another contour than the one that was roughed: to another last block, or "
             "an earlier contour for the second time."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::finishing_of_other_contour
