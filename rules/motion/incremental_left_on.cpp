// incremental-left-on: G91 at the return.
#include "rules/motion/left_on.h"

namespace feedhold::rules::incremental_left_on {
namespace {

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  reportLeftOn({.kind = ModalKind::Distance,
                .actions = {CodeAction::Incremental},
                .atProgramEnd = std::nullopt,
                .consequence = "the caller's absolute coordinates would be read as incremental",
                .remedy = context.dialect.grammar.oWords
                              ? "write M70 at the start and M72 before the end, or write G90"
                              : "restore the mode that #4003 gave at the start, or write G90"},
               facts, context, reporter);
}

} // namespace

extern const Rule incrementalLeftOn;
const Rule incrementalLeftOn{.info = {"incremental-left-on", Category::Motion, Severity::Warning,
                                      "Reports a called program that returns with `G91` active, on some path."},
                             .hooks = {.flow = check}};

} // namespace feedhold::rules::incremental_left_on
