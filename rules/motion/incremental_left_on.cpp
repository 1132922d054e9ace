// incremental-left-on: G91 at the return.
#include "rules/motion/left_on.h"

namespace feedhold::rules {
namespace {

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::Distance,
                .actions = {CodeAction::Incremental},
                .atProgramEnd = std::nullopt,
                .consequence = "the caller's coordinates are taken for distances from here on",
                .remedy = "restore what #4003 said at the head, or write G90"},
               facts, context, reporter);
}

} // namespace

extern const Rule incrementalLeftOn;
const Rule incrementalLeftOn{.info = {"incremental-left-on", Category::Motion, Severity::Warning,
                                      "Reports a called program that returns with `G91` in force, on some path."},
                             .hooks = {.flow = check}};

} // namespace feedhold::rules
