// value-not-returned: `#1=#<_value>` behind the call of a subroutine that returns no value.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::value_not_returned {
namespace {

/// Some `endsub` or `return` of the subroutine has a value behind it.
bool returnsValue(const SyntaxTree &tree, const ProgramModel &model, ProgramId program) {
  const Program &its = model.programs[program];
  return std::ranges::any_of(model.oWordsIn(its.first, its.last), [&](const OWordUse &use) {
    const auto *oWord = std::get_if<OWord>(&tree.statements[use.statement].node);
    return oWord && (use.kind == OWordKind::EndSub || use.kind == OWordKind::Return) && oWord->argumentCount > 0;
  });
}

/// Something else may set the value: a call, or a code that a program stands behind.
bool maySetValue(const FileContext &context, BlockId block) {
  return !context.model.oWordsIn(block, block.next()).empty() || !context.model.callsIn(block, block.next()).empty() ||
         std::ranges::any_of(context.tree.wordsOf(block),
                             [&](const Word &word) { return word.isCode() && !codeOf(word, context.dialect); });
}

/// `#<_value>`, whatever the case and the blanks.
bool isValue(const FileContext &context, const NamedVariable &named) {
  std::string name = comparedName(context.text(named.name));
  std::erase_if(name, [](char c) { return c == '#' || c == '<' || c == '>'; });
  return name == "_value";
}

std::optional<ExpressionId> readOfValue(const FileContext &context, BlockId block) {
  for (const VariableUse &use : context.model.variablesIn(block, block.next())) {
    const auto *named = as<NamedVariable>(context.tree, use.expression);
    if (named && !use.write && isValue(context, *named))
      return use.expression;
  }
  return std::nullopt;
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const auto callee = call.kind == CallKind::OWord ? context.callGraph.callee(context.file, call) : std::nullopt;
  if (!callee || !context.programs)
    return;
  const ProgramFile &file = context.programs->file(callee->file);
  if (returnsValue(*file.tree, *file.model, callee->program))
    return;
  const Program &caller = context.model.programs[call.caller];
  for (BlockId block = call.block.next(); block < caller.last; block = block.next()) {
    if (const auto read = readOfValue(context, block)) {
      reporter.report(
          {.message = fmt::format("{} is read, but `{}` returns no value",
                                  context.quoted(context.tree.expressions[*read].span), toString(call.callee)),
           .span = context.tree.expressions[*read].span,
           .labels = {{call.span, "called here"}},
           .notes = {"without a value behind `endsub` or `return` it is 0",
                     "write the value in brackets behind the `endsub` and each `return`"}});
      return;
    }
    if (maySetValue(context, block))
      return;
  }
}

void asksForPrograms(const FlowFacts &, const FileContext &, const Reporter &) {}

} // namespace

extern const Rule valueNotReturned;
const Rule valueNotReturned{.info = {"value-not-returned", Category::Call, Severity::Warning,
                                     "Reports `#<_value>` behind the call of a subroutine that returns no value."},
                            .hooks = {.call = check, .flow = asksForPrograms}};

} // namespace feedhold::rules::value_not_returned
