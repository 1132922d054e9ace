// default-to-other-variable: `IF[#21EQ#0]THEN#191=100.` where nothing uses what U passes.
#include "rules/flow/definitions.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::default_to_other_variable {
namespace {

/// `IF[#21EQ#0]THEN#191=100.`
struct Default {
  BlockId block;
  std::uint32_t argument;
  std::uint32_t target;
  Span span; // of the target
};

std::optional<std::uint32_t> askedForVacancy(const FileContext &context, ExpressionId condition) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  if (!relation || relation->op != OperatorKind::Equal)
    return std::nullopt;
  if (isVacant(context, relation->right))
    return variableNumber(context.tree, unwrapped(context.tree, relation->left));
  return isVacant(context, relation->left) ? variableNumber(context.tree, unwrapped(context.tree, relation->right))
                                           : std::nullopt;
}

std::optional<Default> defaultIn(const FileContext &context, BlockId block) {
  for (const Statement &statement : context.tree.statementsOf(block)) {
    const auto *branch = std::get_if<If>(&statement.node);
    if (!branch || !branch->condition || !branch->statement)
      continue;
    const auto *assignment = std::get_if<Assignment>(&context.tree.statements[*branch->statement].node);
    const auto argument = askedForVacancy(context, *branch->condition);
    const auto target =
        assignment ? variableNumber(context.tree, unwrapped(context.tree, assignment->target)) : std::nullopt;
    if (argument && target && literalValue(context.tree, assignment->value))
      return Default{block, *argument, *target, context.tree.expressions[assignment->target].span};
  }
  return std::nullopt;
}

/// A common variable: where the argument is passed, it keeps what an earlier call or program left in it.
bool isCommon(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  return range && (range->kind == VariableKind::Common || range->kind == VariableKind::Retentive);
}

/// No other program and no other block of this one sets the variable.
bool isSetOnce(const FlowFacts &facts, std::uint32_t variable) {
  return facts.programs.unnumberedUses().writes + facts.programs.usesOf(variable).writes == 1;
}

bool isBehind(const FlowFacts &facts, BlockId block, const Read &read) {
  const auto from = reachedNode(facts, block);
  const auto to = nodeOf(facts, read.block, read.expression);
  return from && to && findPath(facts, *from, *to, [](NodeId) { return false; });
}

/// `100+#24*2`: a table of common variables.
bool addsTable(const FileContext &context, ExpressionId index) {
  return std::ranges::any_of(termsOf(context.tree, index), [&](const SumTerm &term) {
    const auto base = literalValue(context.tree, term.value);
    return !term.isMinus && base && *base > Decimal(kLocalVariables, 0);
  });
}

/// Of `#[#198+1]` behind `#198=100+#24*2`.
bool isTable(const FlowFacts &facts, const FileContext &context, const Read &read, ExpressionId index) {
  const auto node = nodeOf(facts, read.block, read.expression);
  return node && std::ranges::any_of(termsOf(context.tree, index), [&](const SumTerm &term) {
           const auto variable = variableOf(facts, unwrapped(context.tree, term.value));
           const auto known = variable ? definitionsOf(facts, *variable, *node) : std::nullopt;
           return known && !term.isMinus && !known->fromEntry && std::ranges::all_of(known->nodes, [&](NodeId each) {
                    const auto assignment = assignmentTo(facts, each, *variable);
                    return assignment && addsTable(context, assignment->value);
                  });
         });
}

/// `#[#198]`, where the number may be that of the argument.
bool mayRead(const FlowFacts &facts, const FileContext &context, const Read &read, std::uint32_t argument) {
  if (read.number)
    return *read.number == argument;
  const auto *indirect = as<IndirectVariable>(context.tree, read.expression);
  if (indirect && (addsTable(context, indirect->index) || isTable(facts, context, read, indirect->index)))
    return false;
  const AbstractValue *index = indirect ? facts.valueOf(indirect->index) : nullptr;
  return !index || !index->isNumber() || index->number().interval().contains(argument);
}

/// The program asks whether the argument is there, and does nothing with its value from there on.
bool isOnlyAsked(const FlowFacts &facts, const FileContext &context, std::uint32_t argument, BlockId block) {
  return isParameter(facts, argument) && !maySet(facts, argument) &&
         std::ranges::all_of(readsOf(facts), [&](const Read &read) {
           return !mayRead(facts, context, read, argument) || read.use == ReadUse::Equality ||
                  !isBehind(facts, block, read);
         });
}

/// Where the value counts: in a word or in arithmetic.
std::optional<Span> useOf(const FlowFacts &facts, std::uint32_t variable, BlockId block) {
  for (const Read &read : readsOf(facts))
    if (read.number == variable && (read.use == ReadUse::Word || read.use == ReadUse::Computed) &&
        isBehind(facts, block, read))
      return facts.file.tree->expressions[read.expression].span;
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isMainProgram(facts) || !context.dialect.behaviour.variablesMayBeVacant)
    return;
  for (const BlockId block : blocksOf(facts.file, facts.program)) {
    const auto found = defaultIn(context, block);
    if (!found || !isCommon(context, found->target) || isTested(facts.file, facts.program, found->target) ||
        !isOnlyAsked(facts, context, found->argument, block) || !isSetOnce(facts, found->target))
      continue;
    const auto use = useOf(facts, found->target, block);
    if (!use)
      continue;
    const std::string argument = describeVariable(context.dialect, found->argument);
    reporter.report({.message = fmt::format("the default of {} goes to {}, and nothing uses the argument itself",
                                            argument, context.quoted(found->span)),
                     .span = found->span,
                     .labels = {{*use, "used here"}},
                     .notes = {fmt::format("if {} is passed, `#{}` keeps what an earlier call left there, or is vacant",
                                           argument, found->target),
                               fmt::format("write `#{}` in one of the two places", found->argument)}});
  }
}

} // namespace

extern const Rule defaultToOtherVariable;
const Rule defaultToOtherVariable{
    .info = {"default-to-other-variable", Category::Flow, Severity::Warning,
             "Reports the default of an argument that goes to a common variable, when nothing uses the argument."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::default_to_other_variable
