// scaling-left-on: G51 at the end.
#include "rules/motion/left_on.h"

namespace feedhold::rules {
namespace {

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::Scaling,
                .actions = {CodeAction::ScalingOn},
                .atProgramEnd = Severity::Info,
                .consequence = "every later movement is scaled too",
                .remedy = "cancel it by G50 before the end"},
               facts, context, reporter);
}

} // namespace

extern const Rule scalingLeftOn;
const Rule scalingLeftOn{.info = {"scaling-left-on", Category::Motion, Severity::Warning,
                                  "Reports a scaling that is still on when the program ends or returns, on some path."},
                         .hooks = {.flow = check}};

} // namespace feedhold::rules
