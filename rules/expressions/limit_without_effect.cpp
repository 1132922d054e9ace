// limit-without-effect: `IF[#5GT.05]GOTO90`, `IF[#5GT-.05]GOTO90`: the second one asks for all that the first one does.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace feedhold::rules::limit_without_effect {
namespace {

/// `#5GT-.05`
struct Limit {
  bool isUpper; // GT or GE
  ExpressionId value;
  Decimal number;
  Span span;
};

bool isUpper(OperatorKind op) { return op == OperatorKind::GreaterThan || op == OperatorKind::GreaterOrEqual; }
bool isLower(OperatorKind op) { return op == OperatorKind::LessThan || op == OperatorKind::LessOrEqual; }

/// From one block to the next.  What is modal only changes by the codes between them.
bool mayChange(const FileContext &context, ExpressionId value) {
  const auto number = variableNumber(context.tree, unwrapped(context.tree, value));
  const VariableRole role = number ? roleOf(context, *number) : VariableRole::Plain;
  return role != VariableRole::ModalCode && role != VariableRole::ModalWord && readsLiveValue(context, value);
}

std::optional<Limit> limitIn(const FileContext &context, ExpressionId id) {
  const auto *relation = asInside<BinaryOperation>(context.tree, id);
  const auto number = relation && (isUpper(relation->op) || isLower(relation->op))
                          ? literalValue(context.tree, relation->right)
                          : std::nullopt;
  if (!number || isConstant(context.tree, relation->left) || mayChange(context, relation->left))
    return std::nullopt;
  return Limit{isUpper(relation->op), unwrapped(context.tree, relation->left), *number,
               context.tree.expressions[id].span};
}

bool asksTheSame(const FileContext &context, const Limit &first, const Limit &second) {
  return sameText(context, context.tree.expressions[first.value].span, context.tree.expressions[second.value].span);
}

/// Two limits on one side of one value; the same number with GT and GE is a habit.
bool overlap(const FileContext &context, const Limit &first, const Limit &second) {
  return first.isUpper == second.isUpper && first.number != second.number && asksTheSame(context, first, second);
}

enum class Joined : std::uint8_t { Or, And };

void report(const Limit &first, const Limit &second, Joined joined, const FileContext &context,
            const Reporter &reporter) {
  // In an OR the narrower one adds nothing, in an AND the wider one.
  const bool firstIsNarrower = first.isUpper == (first.number > second.number);
  const bool firstIsVoid = firstIsNarrower == (joined == Joined::Or);
  const Limit &redundant = firstIsVoid ? first : second;
  const Limit &other = firstIsVoid ? second : first;
  const bool isTolerance = first.number == second.number.negated();
  const std::string_view advice =
      !isTolerance    ? (first.isUpper ? "probably GE, or LT for the other one, or another number was meant"
                                       : "probably LE, or GT for the other one, or another number was meant")
      : first.isUpper ? "for a tolerance, ask with LT or LE for the negative limit"
                      : "for a tolerance, ask with GT or GE for the positive limit";
  reporter.report(
      {.message = fmt::format("{} has no effect beside {}", context.quoted(redundant.span), context.quoted(other.span)),
       .span = redundant.span,
       .labels = {{other.span, joined == Joined::Or ? "true whenever the other one is, and it does the same"
                                                    : "true only when the other one is"}},
       .notes = {std::string(advice)}});
}

/// `[#5GT.05]OR[#5GT-.05]`
void checkOperation(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *operation = as<BinaryOperation>(context.tree, id);
  if (!operation || (operation->op != OperatorKind::Or && operation->op != OperatorKind::And))
    return;
  const auto first = limitIn(context, operation->left);
  const auto second = first ? limitIn(context, operation->right) : std::nullopt;
  if (second && overlap(context, *first, *second))
    report(*first, *second, operation->op == OperatorKind::Or ? Joined::Or : Joined::And, context, reporter);
}

/// `IF[#5GT.05]GOTO90`
struct Check {
  Limit limit;
  std::string_view action; // `GOTO90`
};

/// To do it twice is to do it once: a jump, or an assignment of a value that does not depend on what is assigned.
bool isIdempotent(const FileContext &context, const Statement &action, const Limit &limit) {
  const auto *assignment = std::get_if<Assignment>(&action.node);
  if (!assignment)
    return std::holds_alternative<Goto>(action.node);
  const std::string_view target = context.text(context.tree.expressions[assignment->target].span);
  const auto holds = [&](ExpressionId root) {
    return context.text(context.tree.expressions[root].span).find(target) != std::string_view::npos;
  };
  return !holds(assignment->value) && !holds(limit.value);
}

std::optional<Check> checkAt(const FileContext &context, BlockId block) {
  const Statement *statement = firstStatement(context.tree, block);
  const auto *branch = statement ? std::get_if<If>(&statement->node) : nullptr;
  if (!branch || !branch->condition || !branch->statement)
    return std::nullopt;
  const Statement &action = context.tree.statements[*branch->statement];
  const auto limit = limitIn(context, *branch->condition);
  if (!limit || !isIdempotent(context, action, *limit))
    return std::nullopt;
  return Check{*limit, context.text(action.span)};
}

/// Blocks that do the same, one below the other; of a list of them one finding for each value.
void checkBlocks(ProgramId program, const FileContext &context, const Reporter &reporter) {
  std::optional<Check> before;
  std::vector<Limit> told;
  const Program &whole = context.model.programs[program];
  for (BlockId block = whole.first; block < whole.last; block = block.next()) {
    if (isEmpty(context.tree, block))
      continue;
    const auto check = checkAt(context, block);
    if (!check)
      told.clear();
    const auto isTold = [&](const Limit &limit) {
      return std::ranges::any_of(told, [&](const Limit &each) { return asksTheSame(context, each, limit); });
    };
    if (before && check && before->action == check->action && overlap(context, before->limit, check->limit) &&
        !isTold(check->limit)) {
      report(before->limit, check->limit, Joined::Or, context, reporter);
      told.push_back(check->limit);
    }
    before = check;
  }
}

} // namespace

extern const Rule limitWithoutEffect;
const Rule limitWithoutEffect{
    .info = {"limit-without-effect", Category::Expression, Severity::Warning,
             "Reports one of two limits of a value that has no effect, because both are compared in the same direction "
             "and lead to the same."},
    .hooks = {.program = checkBlocks, .expression = checkOperation, .expressionNodes = nodeSet<BinaryOperation>()}};

} // namespace feedhold::rules::limit_without_effect
