// unguarded-division: `#26/#17` where nothing asks whether Q was passed.
#include "rules/flow/definitions.h"
#include "rules/flow/passed_values.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::unguarded_division {
namespace {

/// By the analysis, or where that lost it, by the text.
std::optional<std::uint32_t> argumentIn(const FlowFacts &facts, std::uint32_t variable, const AbstractValue &value) {
  const auto &origin = value.origin();
  if (origin && origin->offset.isZero() && isEntrySymbol(origin->symbol) && isLocal(facts.file, origin->symbol))
    return origin->symbol;
  return argumentBehind(facts, variable);
}

constexpr int kMostCopies = 3;

/// The only assignment to a local variable, which each run makes; absent when there is none or another one.
std::optional<ExpressionId> onlyValue(const FlowFacts &facts, std::uint32_t variable) {
  std::optional<ExpressionId> value;
  for (const BlockId block : blocksOf(facts.file, facts.program))
    for (const Statement &statement : facts.file.tree->statementsOf(block))
      if (const auto *assignment = std::get_if<Assignment>(&statement.node);
          assignment && variableNumber(*facts.file.tree, unwrapped(*facts.file.tree, assignment->target)) == variable) {
        if (value || statement.nested)
          return std::nullopt;
        value = assignment->value;
      }
  return value;
}

/// `[2*#17]`, `ABS[#17]`, and `#30` with `#30=#17*#2`: 0 where the argument is.
std::optional<std::uint32_t> factorIn(const FlowFacts &facts, ExpressionId id, int copies = 0) {
  const SyntaxTree &tree = *facts.file.tree;
  const ExpressionId inner = unwrapped(tree, id);
  if (const auto *call = as<FunctionCall>(tree, inner))
    return call->function == FunctionKind::Abs && !call->arguments().empty()
               ? factorIn(facts, call->arguments().front(), copies)
               : std::nullopt;
  if (const auto *product = as<BinaryOperation>(tree, inner)) {
    if (product->op != OperatorKind::Multiply && product->op != OperatorKind::Divide)
      return std::nullopt;
    if (const auto left = factorIn(facts, product->left, copies))
      return left;
    return product->op == OperatorKind::Multiply ? factorIn(facts, product->right, copies) : std::nullopt;
  }
  const auto variable = variableNumber(tree, inner);
  if (!variable || !isLocal(facts.file, *variable) || isTested(facts.file, facts.program, *variable))
    return std::nullopt;
  if (const auto argument = argumentBehind(facts, *variable))
    return isTested(facts.file, facts.program, *argument) ? std::nullopt : argument;
  const auto value = copies < kMostCopies ? onlyValue(facts, *variable) : std::nullopt;
  return value ? factorIn(facts, *value, copies + 1) : std::nullopt;
}

/// `360/#10` behind `#10=#7`: the copy is checked and counted down only behind the division.
std::optional<std::uint32_t> copiedArgument(const FlowFacts &facts, std::uint32_t variable, NodeId at) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto known = isLocal(facts.file, variable) ? definitionsOf(facts, variable, at) : std::nullopt;
  if (!known || known->fromEntry || known->nodes.size() != 1)
    return std::nullopt;
  const auto assignment = assignmentTo(facts, known->nodes.front(), variable);
  const auto source = assignment ? variableNumber(tree, unwrapped(tree, assignment->value)) : std::nullopt;
  if (!source || argumentBehind(facts, *source) != source)
    return std::nullopt;
  const BlockId division = facts.node(at).block;
  const auto isAskedBefore = [&](const Read &read) {
    return read.number == variable && read.block <= division &&
           (read.use == ReadUse::Equality || read.use == ReadUse::Ordering);
  };
  return std::ranges::any_of(readsOf(facts), isAskedBefore) ? std::nullopt : source;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::vector<std::uint32_t> done;
  if (isMainProgram(facts))
    return; // never set at all: another rule's
  for (const AlarmFact &alarm : facts.alarms()) {
    if (alarm.kind != AlarmKind::DivideByZero || alarm.always)
      continue;
    const BlockId block = facts.node(alarm.node).block;
    const auto divisor = expressionAt(facts, block, alarm.place);
    const auto variable = divisor ? variableNumber(context.tree, unwrapped(context.tree, *divisor)) : std::nullopt;
    const AbstractValue *value = variable ? facts.valueOf(*divisor) : nullptr;
    const auto copied = value ? copiedArgument(facts, *variable, alarm.node) : std::nullopt;
    auto argument = value && isLocal(facts.file, *variable) ? argumentIn(facts, *variable, *value) : std::nullopt;
    argument = argument ? argument : copied;
    const bool isFactor = !argument && divisor && !isTooLarge(facts);
    if (isFactor)
      argument = factorIn(facts, *divisor);
    if (!argument || std::ranges::find(done, *argument) != done.end() ||
        isTested(facts.file, facts.program, *argument) ||
        (variable && !copied && isTested(facts.file, facts.program, *variable)) ||
        mayHoldCallersValue(facts, *argument))
      continue;
    done.push_back(*argument);
    const PassedValues passed = passedFor(*argument, facts, context);
    if (passed.zero == PassedZero::Never)
      continue;
    Diagnostic diagnostic{.message = fmt::format("{} may be 0 or vacant: nothing checks it before this division",
                                                 describeVariable(context.dialect, *argument)),
                          .span = alarm.place,
                          .label = isFactor ? "divides by a multiple of it" : "divides by it",
                          .flow = pathFromEntry(facts, alarm.node),
                          .notes = {fmt::format("if it is not passed, or is 0, the control {}",
                                                stopsWith(context.dialect, AlarmKind::DivideByZero)),
                                    adviceToCheck(context.dialect, *argument)}};
    addPassed(diagnostic, passed, facts);
    reporter.report(std::move(diagnostic));
  }
}

} // namespace

extern const Rule unguardedDivision;
const Rule unguardedDivision{.info = {"unguarded-division", Category::Flow, Severity::Warning,
                                      "Reports a division by an argument that is never checked for 0."},
                             .hooks = {.flow = check}};

} // namespace feedhold::rules::unguarded_division
