// groove-without-depth: from X32. Z-15. a `G74 X28. Z-15.`, which pecks along Z.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

namespace feedhold::rules::groove_without_depth {
namespace {

bool hasAny(const FileContext &context, BlockId block, char a, char b) {
  return findWord(context.tree, block, a) || findWord(context.tree, block, b);
}

void tell(const Word &cycle, bool isFace, const TurningPoint &start, const TurningPoint &end,
          const FileContext &context, const Reporter &reporter) {
  const char axis = isFace ? 'Z' : 'X';
  const auto &across = isFace ? start.x : start.z;
  const auto &acrossEnd = isFace ? end.x : end.z;
  const bool isOtherMeant = across && acrossEnd && *across != *acrossEnd;
  Diagnostic diagnostic{.message = fmt::format("{} has no depth: it cuts along {}, and the tool is already at {}{:g}",
                                               context.quoted(cycle.span()), axis, axis, isFace ? *start.z : *start.x),
                        .span = cycle.span(),
                        .notes = {"the tool does not go into the part"}};
  diagnostic.notes.push_back(isOtherMeant
                                 ? fmt::format("a groove {} is cut by `{}`; or write the depth in {}",
                                               isFace ? "in the diameter" : "in the face", isFace ? "G75" : "G74", axis)
                                 : fmt::format("write the depth in {}", axis));
  reporter.report(std::move(diagnostic));
}

void checkCycle(BlockId block, const TurningPoint &start, const TurningWalk &walk, const FileContext &context,
                const Reporter &reporter) {
  const Word *cycle =
      findAction(context.tree, block, context.dialect, {CodeAction::FaceGroove, CodeAction::DiameterGroove});
  if (!cycle || (!hasAny(context, block, 'X', 'U') && !hasAny(context, block, 'Z', 'W')))
    return; // `G74 R0.5` says how to cut
  const bool isFace = codeOf(*cycle, context.dialect)->action == CodeAction::FaceGroove;
  const TurningPoint end = walk.endOf(block);
  const auto &from = isFace ? start.z : start.x;
  const auto &to = isFace ? end.z : end.x;
  if (from && to && *from == *to)
    tell(*cycle, isFace, start, end, context, reporter);
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  forEachTurningCycle(program, context, [&](BlockId block, const TurningPoint &start, const TurningWalk &walk) {
    checkCycle(block, start, walk, context, reporter);
  });
}

} // namespace

extern const Rule grooveWithoutDepth;
const Rule grooveWithoutDepth{.info = {"groove-without-depth", Category::Motion, Severity::Warning,
                                       "Reports a grooving cycle of a lathe whose end point lies where the tool "
                                       "already is along the axis in which it cuts."},
                              .hooks = {.program = check}};

} // namespace feedhold::rules::groove_without_depth
