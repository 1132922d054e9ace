// case-without-default: jumps by the value of a variable, and what is left over runs into the first case.
#include "rules/flow/case_ladder.h"
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::case_without_default {
namespace {

/// The analysis knows bounds of the variable, not its values: its range has been checked before.
bool isChecked(const FlowFacts &facts, BlockId last, std::uint32_t variable) {
  for (const Read &read : readsOf(facts.file, last))
    if (const AbstractValue *value = read.number == variable ? facts.valueOf(read.expression) : nullptr)
      return value->isNumber() && value->number().interval().isFinite() && value->number().set().isMany();
  return false;
}

/// The values that were not asked for, none of them is left.
bool isExhausted(const FlowFacts &facts, BlockId last) {
  for (NodeId node = facts.file.cfg.nodeOf(last); node < facts.end() && facts.node(node).block == last;
       node = node.next())
    if (std::holds_alternative<Test>(facts.node(node).instruction))
      return facts.truthOf(node).value_or(Truth::True) == Truth::True;
  return true;
}

/// All lines jump, and none of them is decided.
bool selects(const FlowFacts &facts, const CaseLadder &ladder) {
  return std::ranges::all_of(ladder.cases, [&](const CaseLine &line) {
    const AbstractValue *value = facts.valueOf(line.selector);
    const bool isDecided = value && value->isNumber() && value->number().isConstant();
    return line.jump && line.jump->target && !isDecided;
  });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const CaseLadder &ladder : caseLaddersOf(context, facts.program)) {
    const CaseLine &last = ladder.cases.back();
    if (!selects(facts, ladder) || ladder.behind != *ladder.cases.front().jump->target ||
        isExhausted(facts, last.block) || isChecked(facts, last.block, last.variable))
      continue;
    reporter.report({.message = fmt::format("any other value of `#{}` falls through to the first case", last.variable),
                     .span = last.statement->span,
                     .label = "last comparison",
                     .labels = {{context.tree.blocks[ladder.behind].span(), "any other value continues here"}},
                     .notes = {"put an alarm or a GOTO after the last comparison"}});
  }
}

} // namespace

extern const Rule caseWithoutDefault;
const Rule caseWithoutDefault{
    .info = {"case-without-default", Category::Flow, Severity::Info,
             "Reports a chain of `IF[..EQ..]GOTO` in which any other value falls through to the first case."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::case_without_default
