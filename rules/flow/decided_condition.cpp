// decided-condition: an IF that can have one outcome only, given what was decided or computed before it.
#include "rules/flow/loop_view.h"
#include "rules/flow/void_check.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::decided_condition {
namespace {

/// `#101EQ#0`: whether a variable is vacant is asked.
bool asksVacancy(const FileContext &context, ExpressionId condition) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  return relation && (isVacant(context, relation->left) || isVacant(context, relation->right));
}

/// It should raise an alarm, and never does, for a reason that shows a mistake.
std::optional<VoidReason> voidReason(const FlowFacts &facts, const FileContext &context, NodeId node,
                                     ExpressionId condition, Truth truth) {
  const auto alarm = alarmWhenTrue(facts, node);
  return alarm && *alarm == (truth == Truth::False) ? whyVoid(facts, context, node, condition) : std::nullopt;
}

void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter, NodeId node,
            ExpressionId condition, Truth truth, std::optional<VoidReason> reason, std::string_view effect) {
  const Span span = context.tree.expressions[condition].span;
  Diagnostic diagnostic{.message = fmt::format("{} {} here{}", context.quoted(span),
                                               truth == Truth::True ? "is always true" : "is never true", effect),
                        .span = span,
                        .flow = pathFromEntry(facts, node)};
  if (reason) {
    if (reason->label)
      diagnostic.labels.push_back(std::move(*reason->label));
    diagnostic.notes.push_back(std::move(reason->note));
  } else {
    diagnostic.notes.emplace_back(asksVacancy(context, condition) && truth == Truth::False
                                      ? "it has been set before, so it holds a number and is not vacant"
                                      : "the blocks before it leave no other outcome");
  }
  reporter.report(std::move(diagnostic), reason ? Severity::Warning : Severity::Info);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isMainProgram(facts))
    return; // settings at its head are asked on purpose
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto truth = test && test->condition ? facts.truthOf(node) : std::nullopt;
    if (!truth || *truth == Truth::Maybe || isConstant(context.tree, *test->condition))
      continue;
    const BlockId block = facts.node(node).block;
    const auto statements = context.tree.statementsOf(block);
    const bool isWhile =
        std::ranges::any_of(statements, [](const Statement &s) { return std::holds_alternative<While>(s.node); });
    auto reason = isWhile ? std::nullopt : voidReason(facts, context, node, *test->condition, *truth);
    const bool toBeSure =
        isAskedToBeSure(facts, *test->condition, block) && !(reason && asksVacancy(context, *test->condition));
    if (isWhile || toBeSure)
      continue;
    if (reason) // an alarm
      report(facts, context, reporter, node, *test->condition, *truth, reason, ": this check cannot raise its alarm");
    else if (reason = whatNeverRuns(facts, context, node, *test->condition, *truth); reason)
      report(facts, context, reporter, node, *test->condition, *truth, reason, ": blocks behind it never run");
    else
      report(facts, context, reporter, node, *test->condition, *truth, reason, "");
  }
}

} // namespace

extern const Rule decidedCondition;
const Rule decidedCondition{.info = {"decided-condition", Category::Flow, Severity::Warning,
                                     "Reports a condition that always has the same outcome."},
                            .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::decided_condition
