// scaling-left-on: G51 at the end.
#include "rules/motion/left_on.h"

namespace feedhold::rules::scaling_left_on {
namespace {

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::Scaling,
                .actions = {CodeAction::ScalingOn},
                .atProgramEnd = Severity::Info,
                .consequence = "every later move is scaled too",
                .remedy = "cancel it with G50 before the end",
                .followsHabit = context.dialect.hasFanucParameters},
               facts, context, reporter);
}

} // namespace

extern const Rule scalingLeftOn;
const Rule scalingLeftOn{
    .info = {"scaling-left-on", Category::Motion, Severity::Warning,
             "Reports scaling that is still active when the program ends or returns, on some path."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::scaling_left_on
