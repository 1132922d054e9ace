// flag-never-cleared: `IF[#5003LT1.]THEN#100=1` and `IF[#100EQ1]GOTO9`: once it is 1, it stays 1 in every later run.
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

namespace feedhold::rules::flag_never_cleared {
namespace {

struct Flag {
  std::vector<Span> sets;
  std::optional<Decimal> value;
  bool isFlag = true; // all that sets it is the same number behind an IF
};

bool isKept(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  return range && range->kind == VariableKind::Common;
}

/// Something that sets a common variable by a computed number, or a program that is not there.
bool mayBeSetUnseen(const FlowFacts &facts, const FileContext &context) {
  return facts.programs.unnumberedUses().writes != 0 || std::ranges::any_of(context.model.calls, [&](const Call &call) {
           return call.kind != CallKind::ModalCancel && !context.callGraph.callee(context.file, call);
         });
}

std::size_t writesIn(const FileContext &context, std::uint32_t variable) {
  return static_cast<std::size_t>(std::ranges::count_if(
      context.model.variables, [&](const VariableUse &use) { return use.write && use.number == variable; }));
}

std::map<std::uint32_t, Flag> flagsOf(const FlowFacts &facts, const FileContext &context) {
  std::map<std::uint32_t, Flag> flags;
  for (const VariableUse &use : context.model.variables)
    if (use.write && use.number && isKept(context, *use.number) && !flags.contains(*use.number))
      flags[*use.number].isFlag = facts.programs.usesOf(*use.number).writes == writesIn(context, *use.number);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    for (const Assignment &assignment : assignmentsOf(facts, node)) {
      const auto number = variableNumber(context.tree, unwrapped(context.tree, assignment.target));
      const auto at = number ? flags.find(*number) : flags.end();
      if (at == flags.end())
        continue;
      Flag &flag = at->second;
      const BlockId block = facts.node(node).block;
      const auto value = literalValue(context.tree, assignment.value);
      const bool isBehindIf = std::ranges::any_of(context.tree.statementsOf(block), [](const Statement &statement) {
        return std::holds_alternative<If>(statement.node);
      });
      flag.isFlag = flag.isFlag && value && !value->isZero() && isBehindIf && (!flag.value || *flag.value == *value);
      flag.value = value;
      flag.sets.push_back(context.tree.blocks[block].span());
    }
  return flags;
}

/// `#100EQ1` in a condition.
std::optional<Span> testOf(const FlowFacts &facts, const FileContext &context, std::uint32_t variable,
                           const Decimal &value) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto *relation = test && test->condition && facts.isReached(node)
                               ? asInside<BinaryOperation>(context.tree, *test->condition)
                               : nullptr;
    if (relation && relation->op == OperatorKind::Equal &&
        variableNumber(context.tree, unwrapped(context.tree, relation->left)) == variable &&
        literalValue(context.tree, relation->right) == value)
      return context.tree.expressions[*test->condition].span;
  }
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || context.dialect.grammar.oWords || mayBeSetUnseen(facts, context))
    return;
  for (const auto &[variable, flag] : flagsOf(facts, context)) {
    if (!flag.isFlag || flag.sets.empty() || flag.sets.size() != writesIn(context, variable) ||
        isPromised(facts, context, variable))
      continue;
    const auto test = testOf(facts, context, variable, *flag.value);
    if (!test)
      continue;
    reporter.report(
        {.message = fmt::format("`#{}` is never set back: once it is {} it stays so", variable, flag.value->toString()),
         .span = flag.sets.front(),
         .labels = {{*test, "true from then on, in later runs as well"}},
         .notes = {"common variables keep their values until the control is switched off",
                   fmt::format("write `#{}=0` at the head of the program", variable)}});
  }
}

} // namespace

extern const Rule flagNeverCleared;
const Rule flagNeverCleared{.info = {"flag-never-cleared", Category::Flow, Severity::Warning,
                                     "Reports a common variable that conditions set, and that nothing sets back."},
                            .hooks = {.flow = check}};

} // namespace feedhold::rules::flag_never_cleared
