// repeated-case: `IF[#1EQ2]GOTO20`, and in the same list `IF[#1EQ2]GOTO30`.
#include "rules/flow/case_ladder.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::repeated_case {
namespace {

const Assignment *assignmentOf(const FileContext &context, const CaseLine &line) {
  const auto &branch = std::get<If>(line.statement->node);
  return branch.action == IfAction::Statement && branch.statement
             ? std::get_if<Assignment>(&context.tree.statements[*branch.statement].node)
             : nullptr;
}

/// What the first line does leaves nothing to the second: it jumps away, or both set one variable.
bool excludes(const FileContext &context, const CaseLine &first, const CaseLine &second) {
  if (first.jump)
    return !second.jump || second.jump->number != first.jump->number;
  const Assignment *left = assignmentOf(context, first);
  const Assignment *right = assignmentOf(context, second);
  const auto spanOf = [&](ExpressionId id) { return context.tree.expressions[id].span; };
  return left && right && sameText(context, spanOf(left->target), spanOf(right->target)) &&
         !sameText(context, spanOf(left->value), spanOf(right->value));
}

/// Some line up to this one sets the variable that is asked: the list asks for another value then.
bool setsSelector(const FileContext &context, const CaseLine &line) {
  const Assignment *assignment = assignmentOf(context, line);
  return assignment && variableNumber(context.tree, assignment->target) == line.variable;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  for (const CaseLadder &ladder : caseLaddersOf(context, program))
    for (std::size_t second = 1; second < ladder.cases.size(); ++second)
      for (std::size_t first = second; first-- > 0 && !setsSelector(context, ladder.cases[first]);) {
        const CaseLine &line = ladder.cases[second];
        const CaseLine &before = ladder.cases[first];
        if (line.value != before.value || !excludes(context, before, line))
          continue;
        reporter.report({.message = fmt::format("{} asks for a value that this list has asked for already",
                                                context.quoted(line.statement->span)),
                         .span = line.statement->span,
                         .labels = {{before.statement->span, "the first one"}},
                         .notes = {before.jump ? "the first one jumps away, so this one is never executed"
                                               : "both set the same variable, so the first one has no effect",
                                   "correct the value of one of them"}});
        break;
      }
}

} // namespace

extern const Rule repeatedCase;
const Rule repeatedCase{.info = {"repeated-case", Category::Flow, Severity::Warning,
                                 "Reports a value that a list of `IF[..EQ..]` asks for twice, with another action."},
                        .hooks = {.program = check}};

} // namespace feedhold::rules::repeated_case
