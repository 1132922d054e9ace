// case-without-default: jumps by the value of a variable, and what is left over runs into the first case.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::case_without_default {
namespace {

struct Case {
  std::uint32_t variable;
  BlockId target;
  Span span;
};

/// `IF[#131EQ2]GOTO2` alone in its block.
std::optional<Case> caseAt(const FlowFacts &facts, const FileContext &context, BlockId block) {
  const auto jumps = context.model.jumpsIn(block, block.next());
  const Statement *statement = firstStatement(context.tree, block);
  const auto *branch = statement ? std::get_if<If>(&statement->node) : nullptr;
  const auto *relation =
      branch && branch->condition ? asInside<BinaryOperation>(context.tree, *branch->condition) : nullptr;
  if (!relation || relation->op != OperatorKind::Equal || jumps.size() != 1 || !jumps.front().target)
    return std::nullopt;
  const auto variable = variableNumber(context.tree, unwrapped(context.tree, relation->left));
  const AbstractValue *value = facts.valueOf(unwrapped(context.tree, relation->left));
  const bool isDecided = value && value->isNumber() && value->number().isConstant();
  if (!variable || !literalValue(context.tree, relation->right) || isDecided)
    return std::nullopt;
  return Case{*variable, *jumps.front().target, statement->span};
}

/// The next block in which something stands.
BlockId nextContent(const FileContext &context, BlockId block) {
  do
    block = block.next();
  while (block.index() + 1 < context.tree.blocks.size() && isEmpty(context.tree, block));
  return block;
}

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

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[facts.program];
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    std::vector<Case> cases;
    BlockId last = block;
    for (BlockId each = block; each < program.last; each = nextContent(context, each)) {
      const auto found = caseAt(facts, context, each);
      if (!found || (!cases.empty() && found->variable != cases.front().variable))
        break;
      cases.push_back(*found);
      last = each;
    }
    if (cases.size() < 2)
      continue;
    block = last;
    const BlockId behind = nextContent(context, last);
    if (behind != cases.front().target || isExhausted(facts, last) || isChecked(facts, last, cases.front().variable))
      continue;
    reporter.report(
        {.message = fmt::format("any other value of `#{}` falls through to the first case", cases.front().variable),
         .span = cases.back().span,
         .label = "last comparison",
         .labels = {{context.tree.blocks[behind].span(), "any other value continues here"}},
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
