// inverse-time-left-on: G93 at the end.
#include "rules/motion/left_on.h"

namespace feedhold::rules::inverse_time_left_on {
namespace {

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::FeedMode,
                .actions = {CodeAction::FeedInverse},
                .atProgramEnd = Severity::Warning,
                .consequence = "every later F is read as inverse time, and each cutting block needs its own F",
                .remedy = "write G94 before the end"},
               facts, context, reporter);
}

} // namespace

extern const Rule inverseTimeLeftOn;
const Rule inverseTimeLeftOn{
    .info = {"inverse-time-left-on", Category::Motion, Severity::Warning,
             "Reports inverse time feed that is still active when the program ends or returns, on some path."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::inverse_time_left_on
