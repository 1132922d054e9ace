// polar-left-on: G16 at the end.
#include "rules/motion/left_on.h"

namespace feedhold::rules::polar_left_on {
namespace {

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::Polar,
                .actions = {CodeAction::PolarOn},
                .atProgramEnd = Severity::Info,
                .consequence = "every later X is read as a radius and every Y as an angle",
                .remedy = "cancel it with G15 before the end",
                .followsHabit = context.dialect.hasFanucParameters},
               facts, context, reporter);
}

} // namespace

extern const Rule polarLeftOn;
const Rule polarLeftOn{
    .info = {"polar-left-on", Category::Motion, Severity::Warning,
             "Reports polar coordinates that are still active when the program ends or returns, on some path."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::polar_left_on
