// rotation-left-on: G68 at the end.
#include "rules/motion/left_on.h"

namespace feedhold::rules::rotation_left_on {
namespace {

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::Rotation,
                .actions = {CodeAction::RotationOn},
                .atProgramEnd = Severity::Info,
                .consequence = "every later move is rotated too",
                .remedy = "cancel it with G69 before the end",
                .followsHabit = context.dialect.hasFanucParameters},
               facts, context, reporter);
}

} // namespace

extern const Rule rotationLeftOn;
const Rule rotationLeftOn{
    .info = {"rotation-left-on", Category::Motion, Severity::Warning,
             "Reports a coordinate rotation that is still active when the program ends or returns, on some path."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::rotation_left_on
