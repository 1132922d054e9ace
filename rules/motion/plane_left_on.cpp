// plane-left-on: G18 or G19 at the return.
#include "rules/motion/left_on.h"

#include <algorithm>
#include <array>

namespace feedhold::rules::plane_left_on {
namespace {

/// The file of a control that has one table for mills and lathes speaks of diameters, of constant surface speed or of a
/// threading cycle.
bool isOfLathe(const FileContext &context) {
  if (!context.dialect.grammar.oWords)
    return false;
  constexpr std::array<std::uint16_t, 4> kOfLathes = {70, 80, 760, 960}; // G7, G8, G76, G96
  for (BlockId block(0); block.index() < context.tree.blockCount(); block = block.next())
    for (const Word &word : context.tree.wordsOf(block))
      if (const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr)
        if (std::ranges::find(kOfLathes, code->tenths) != kOfLathes.end())
          return true;
  return false;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine == MachineKind::Turning || isOfLathe(context)) // G18 is the plane of every program
    return;
  reportLeftOn({.kind = ModalKind::Plane,
                .actions = {CodeAction::PlaneZX, CodeAction::PlaneYZ},
                .atProgramEnd = std::nullopt,
                .consequence = "the caller's arcs, canned cycles and cutter compensation would work in the wrong plane",
                .remedy = context.dialect.grammar.oWords
                              ? "write M70 at the start and M72 before the end, or write G17"
                              : "restore the plane that #4002 gave at the start, or write G17"},
               facts, context, reporter);
}

} // namespace

extern const Rule planeLeftOn;
const Rule planeLeftOn{.info = {"plane-left-on", Category::Motion, Severity::Warning,
                                "Reports a called program that returns with `G18` or `G19` active, on some path."},
                       .hooks = {.flow = check}};

} // namespace feedhold::rules::plane_left_on
