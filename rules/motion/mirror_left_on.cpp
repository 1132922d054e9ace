// mirror-left-on: G51.1 at the end.
#include "rules/motion/left_on.h"

namespace feedhold::rules::mirror_left_on {
namespace {

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::Mirror,
                .actions = {CodeAction::MirrorOn},
                .atProgramEnd = Severity::Info,
                .consequence = "every later move is mirrored too",
                .remedy = "cancel it with G50.1 before the end",
                .followsHabit = context.dialect.hasFanucParameters},
               facts, context, reporter);
}

} // namespace

extern const Rule mirrorLeftOn;
const Rule mirrorLeftOn{
    .info = {"mirror-left-on", Category::Motion, Severity::Warning,
             "Reports a mirror image that is still active when the program ends or returns, on some path."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::mirror_left_on
