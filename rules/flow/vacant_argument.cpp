// vacant-argument: `G65P9010D#8` with a `#8` that nothing ever sets.
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

namespace feedhold::rules::vacant_argument {
namespace {

void checkCall(const Call &call, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const Argument &argument : call.arguments) {
    const Word &word = context.tree.words[argument.word];
    if (argument.role != ArgumentRole::Passed || word.form() != WordForm::Expression)
      continue;
    const auto variable = variableNumber(context.tree, unwrapped(context.tree, word.expression()));
    if (!variable || !isNeverSet(facts, *variable) || isTestedForVacancy(facts.file, facts.program, *variable))
      continue;
    reporter.report(
        {.message = fmt::format("{} passes nothing: `#{}` is never set", context.quoted(word.span()), *variable),
         .span = word.span(),
         .labels = {{call.span, "in this call"}},
         .notes = {fmt::format("`#{}` of the macro stays vacant, as if {} were not written", argument.variable,
                               word.address()),
                   "set the variable before the call, or correct its number"}});
  }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const CallFact &fact : facts.calls())
    checkCall(context.model.calls[fact.call], facts, context, reporter);
}

} // namespace

extern const Rule vacantArgument;
const Rule vacantArgument{.info = {"vacant-argument", Category::Flow, Severity::Warning,
                                   "Reports an argument of a macro call whose variable is never set."},
                          .hooks = {.flow = check}};

} // namespace feedhold::rules::vacant_argument
