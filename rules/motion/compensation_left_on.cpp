// compensation-left-on: G41 or G42 at the end.
#include "rules/motion/left_on.h"

namespace feedhold::rules::compensation_left_on {
namespace {

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::Compensation,
                .actions = {CodeAction::CompensationLeft, CodeAction::CompensationRight},
                .atProgramEnd = Severity::Warning,
                .consequence = "the next move is offset too, and the first move after G40 may cut into the part",
                .remedy = "cancel it with G40 in a move away from the part"},
               facts, context, reporter);
}

} // namespace

extern const Rule compensationLeftOn;
const Rule compensationLeftOn{
    .info = {"compensation-left-on", Category::Motion, Severity::Warning,
             "Reports cutter compensation that is still active when the program ends or returns, on some path."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::compensation_left_on
