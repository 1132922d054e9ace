// decided-condition: an IF that can have one outcome only, given what was decided or computed before it.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules {
namespace {

/// Settings at the head of a program are asked on purpose: a variable that is set once, from numbers and other
/// settings.
class Settings {
public:
  explicit Settings(const FlowFacts &facts) : facts_(facts) {}

  bool contains(std::uint32_t variable, int depth = 0) const {
    const SyntaxTree &tree = *facts_.file.tree;
    std::optional<ExpressionId> value;
    for (const VariableUse &use : facts_.file.model->variablesOf(facts_.program)) {
      if (!use.write || use.number != variable)
        continue;
      if (value)
        return false;
      for (const Statement &statement : tree.statementsOf(use.block))
        if (const auto *assignment = std::get_if<Assignment>(&statement.node);
            assignment && !statement.nested && unwrapped(tree, assignment->target) == use.expression)
          value = assignment->value;
      if (!value)
        return false;
    }
    if (!value || depth > 3)
      return false;
    const auto parts = subexpressions(tree, *value);
    return std::ranges::all_of(parts, [&](ExpressionId part) {
      if (as<IndirectVariable>(tree, part) || as<NamedVariable>(tree, part) || as<FunctionCall>(tree, part))
        return false;
      const auto number = variableNumber(tree, part);
      return !number || contains(*number, depth + 1);
    });
  }

private:
  const FlowFacts &facts_;
};

bool asksSettings(const FlowFacts &facts, ExpressionId condition, BlockId block) {
  const Settings settings(facts);
  const auto reads = readsIn(facts.file, condition, block);
  return std::ranges::all_of(reads, [&](const Read &read) {
    return read.number && (*read.number == kVacantVariable || settings.contains(*read.number));
  });
}

/// `#101EQ#0`: whether a variable is vacant is asked.
bool asksVacancy(const FileContext &context, ExpressionId condition) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  return relation && (isVacant(context, relation->left) || isVacant(context, relation->right));
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto truth = test && test->condition ? facts.truthOf(node) : std::nullopt;
    if (!truth || *truth == Truth::Maybe || isConstant(context.tree, *test->condition))
      continue;
    const BlockId block = facts.node(node).block;
    const auto statements = context.tree.statementsOf(block);
    const bool isWhile =
        std::ranges::any_of(statements, [](const Statement &s) { return std::holds_alternative<While>(s.node); });
    const bool vacancy = asksVacancy(context, *test->condition);
    if (isWhile || (!vacancy && asksSettings(facts, *test->condition, block)))
      continue;
    const Span span = context.tree.expressions[*test->condition].span;
    reporter.report({.message = fmt::format("{} {} here", context.quoted(span),
                                            *truth == Truth::True ? "always holds" : "never holds"),
                     .span = span,
                     .way = wayFromEntry(facts, node),
                     .notes = {vacancy && *truth == Truth::False ? "it has been set before: it is a number"
                                                                 : "what stands before it leaves no other outcome"}});
  }
}

} // namespace

extern const Rule decidedCondition;
const Rule decidedCondition{.info = {"decided-condition", Category::Flow, Severity::Warning,
                                     "Reports a condition that has the same outcome in all runs."},
                            .hooks = {.flow = check}};

} // namespace feedhold::rules
