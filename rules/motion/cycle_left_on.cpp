// cycle-left-on: a canned cycle at the end.
#include "rules/motion/left_on.h"

namespace feedhold::rules::cycle_left_on {
namespace {

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::Cycle,
                .actions = {CodeAction::CycleDrill, CodeAction::CycleDwell, CodeAction::CyclePeck,
                            CodeAction::CycleChipBreak, CodeAction::CycleTap, CodeAction::CycleTapLeft,
                            CodeAction::CycleBore, CodeAction::CycleBoreStop, CodeAction::CycleBackBore,
                            CodeAction::CycleBoreManual, CodeAction::CycleBoreDwell, CodeAction::CycleFineBore},
                .atProgramEnd = std::nullopt,
                .consequence = "the caller's next block with an axis word drills another hole",
                .remedy = "cancel it with G80 before the return"},
               facts, context, reporter);
}

} // namespace

extern const Rule cycleLeftOn;
const Rule cycleLeftOn{
    .info = {"cycle-left-on", Category::Motion, Severity::Warning,
             "Reports a canned cycle that is still active when a called program returns, on some path."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::cycle_left_on
