// zero-is-not-vacant: `#101=0` as the default, then `IF[#101EQ#0]`.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace feedhold::rules::zero_is_not_vacant {
namespace {

/// `#101EQ#0`: the variable.
std::optional<std::uint32_t> askedForVacancy(const FileContext &context, ExpressionId condition) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  if (!relation || (relation->op != OperatorKind::Equal && relation->op != OperatorKind::NotEqual) ||
      !isVacant(context, relation->right))
    return std::nullopt;
  const auto variable = variableNumber(context.tree, unwrapped(context.tree, relation->left));
  return variable == kVacantVariable ? std::nullopt : variable;
}

struct Settings {
  std::vector<NodeId> all;
  std::vector<NodeId> toZero;
  bool maySetVacant = false; // a copy of another variable
};

Settings settingsOf(const FlowFacts &facts, std::uint32_t variable, const FileContext &context) {
  Settings settings;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    settings.maySetVacant = settings.maySetVacant || std::holds_alternative<CallProgram>(facts.node(node).instruction);
    for (const Assignment &assignment : assignmentsOf(facts, node)) {
      if (!facts.isReached(node) ||
          variableNumber(context.tree, unwrapped(context.tree, assignment.target)) != variable)
        continue;
      settings.all.push_back(node);
      const ExpressionId value = unwrapped(context.tree, assignment.value);
      const auto literal = literalValue(context.tree, value);
      if (literal && literal->isZero())
        settings.toZero.push_back(node);
      settings.maySetVacant =
          settings.maySetVacant || as<NumberedVariable>(context.tree, value) || as<NamedVariable>(context.tree, value);
    }
  }
  return settings;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  std::map<std::uint32_t, Settings> settingsByVariable;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto variable =
        test && test->condition && facts.isReached(node) ? askedForVacancy(context, *test->condition) : std::nullopt;
    if (!variable || facts.truthOf(node) != Truth::Maybe)
      continue;
    const auto [known, isNew] = settingsByVariable.try_emplace(*variable);
    if (isNew)
      known->second = settingsOf(facts, *variable, context);
    const Settings &settings = known->second;
    const auto sets = [&](NodeId each) { return std::ranges::find(settings.all, each) != settings.all.end(); };
    if (settings.maySetVacant || settings.toZero.empty() || findPath(facts, facts.entry(), node, sets))
      continue;
    for (const NodeId zero : settings.toZero) {
      const auto path = findPath(facts, zero, node, sets);
      if (!path)
        continue;
      const Span span = context.tree.expressions[*test->condition].span;
      reporter.report({.message = fmt::format("{} tests whether `#{}` is vacant, but it was set to 0",
                                              context.quoted(span), *variable),
                       .span = span,
                       .labels = {{context.tree.blocks[facts.node(zero).block].span(), "set to 0 here"}},
                       .flow = describePath(facts, *path),
                       .notes = {"0 is a number, so the variable is not vacant on this path",
                                 fmt::format("test `[#{} EQ 0]`, or set it to `#0` instead of 0", *variable)}});
      break;
    }
  }
}

} // namespace

extern const Rule zeroIsNotVacant;
const Rule zeroIsNotVacant{.info = {"zero-is-not-vacant", Category::Flow, Severity::Warning,
                                    "Reports a test for vacant of a variable that was set to 0."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules::zero_is_not_vacant
