// arc-without-centre: `G02 X10. Y0.`.
#include "findings/rule/rule.h"
#include "language/model/word_habits.h"

#include <fmt/format.h>

namespace feedhold::rules::arc_without_centre {
namespace {

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Switch setting = context.dialect.switches.cir;
  const Word *arc = setting == Switch::Off ? nullptr : arcWithoutCentre(context.tree, block, context.dialect);
  if (!arc)
    return;
  reporter.report({.message = fmt::format("{} has neither `R` nor `I J K`", context.quoted(arc->span())),
                   .span = arc->span(),
                   .notes = {fmt::format("the control {}{}", stopsWith(context.dialect, AlarmKind::ArcWithoutCentre),
                                         context.dialect.hasFanucParameters && setting == Switch::Unknown
                                             ? ", or moves in a straight line if parameter 3403#5 (CIR) is 0"
                                             : ""),
                             "add R or I, J, K; for a straight move write G01"}});
}

} // namespace

extern const Rule arcWithoutCentre;
const Rule arcWithoutCentre{.info = {"arc-without-centre", Category::Word, Severity::Error,
                                     "Reports an arc with an end point but without `R` and without `I J K`."},
                            .hooks = {.block = check}};

} // namespace feedhold::rules::arc_without_centre
