// loop-never-entered: the condition of a WHILE does not hold in any run.
#include "base/support/text.h"
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::loop_never_entered {
namespace {

std::string valuesOf(const FlowFacts &facts, const FileContext &context, ExpressionId condition, BlockId block) {
  std::string text;
  std::vector<std::uint32_t> done;
  for (const Read &read : readsIn(facts.file, condition, block)) {
    const AbstractValue *value = facts.valueOf(read.expression);
    if (!value || !read.number || std::ranges::find(done, *read.number) != done.end())
      continue;
    done.push_back(*read.number);
    const auto constant = value->isNumber() ? value->number().constantValue() : std::nullopt;
    if (!constant && !value->isVacant())
      continue;
    const std::string shown = constant ? fmt::format("{:.6g}", *constant) : std::string("vacant");
    text += fmt::format("{}{} is {}", text.empty() ? "" : ", ",
                        context.quoted(context.tree.expressions[read.expression].span), shown);
  }
  return text;
}

/// Where the operator writes a number: `#12= -0.1 ( )`.
bool isBlankToFill(BlockId block, const FileContext &context) {
  return std::ranges::any_of(context.tree.commentsOf(block), [&](const Comment &comment) {
    const std::string_view text = context.text(comment.span);
    return text.size() > 2 && trimmed(text.substr(1, text.size() - 2)).empty();
  });
}

/// The bounds are numbers that a template leaves to the operator: the loop may be skipped on purpose.
bool comparesBlanks(ExpressionId condition, BlockId block, const FlowFacts &facts, const FileContext &context) {
  std::vector<std::uint32_t> variables;
  for (const Read &read : readsIn(facts.file, condition, block))
    if (read.number)
      variables.push_back(*read.number);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    for (const Assignment &assignment : assignmentsOf(facts, node)) {
      const auto target = variableNumber(context.tree, unwrapped(context.tree, assignment.target));
      if (target && std::ranges::find(variables, *target) != variables.end() &&
          literalValue(context.tree, assignment.value) && isBlankToFill(facts.node(node).block, context))
        return true;
    }
  return false;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition || isConstant(context.tree, *test->condition))
      continue;
    const BlockId block = facts.node(node).block;
    const auto statements = context.tree.statementsOf(block);
    const bool isWhile = std::ranges::any_of(statements, [&](const Statement &s) {
      const auto *loop = std::get_if<While>(&s.node); // not an IF that stands behind DO
      return loop && loop->condition == *test->condition;
    });
    if (!isWhile || facts.truthOf(node) != Truth::False)
      continue;
    const Span span = context.tree.expressions[*test->condition].span;
    const std::string values = valuesOf(facts, context, *test->condition, block);
    reporter.report({.message = fmt::format("this loop is never entered: {} is always false", context.quoted(span)),
                     .span = span,
                     .label = values,
                     .notes = {"whatever the loop was meant to cut is left out, without an alarm"}},
                    comparesBlanks(*test->condition, block, facts, context) ? Severity::Info : Severity::Warning);
  }
}

} // namespace

extern const Rule loopNeverEntered;
const Rule loopNeverEntered{.info = {"loop-never-entered", Category::Flow, Severity::Warning,
                                     "Reports a `WHILE` whose condition is never true."},
                            .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::loop_never_entered
