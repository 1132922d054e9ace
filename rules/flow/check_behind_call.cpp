// check-behind-call: `G65 P8503 T#1`, which begins with `GOTO#20`, and only then `IF[#1LE0]GOTO90`.
#include "rules/flow/definitions.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::check_behind_call {
namespace {

/// The jump with which the program begins, to the number that the argument holds.
std::optional<Span> jumpAtHead(const FlowFacts &facts, ProgramRef callee, std::uint32_t argument) {
  const ProgramFile &file = facts.programs.file(callee.file);
  const Program &program = file.model->programs[callee.program];
  for (const Jump &jump : file.model->jumpsOf(callee.program)) {
    const bool isPlain = jump.computed && !jump.conditional &&
                         variableNumber(*file.tree, unwrapped(*file.tree, *jump.computed)) == argument;
    if (!isPlain)
      return std::nullopt;
    for (BlockId block = program.first; block < jump.block; block = block.next())
      if (!file.tree->statementsOf(block).empty())
        return std::nullopt;
    return jump.span;
  }
  return std::nullopt;
}

/// `#1LE0`, `#1LT1`, `#1EQ0`: no sequence number.
bool refusesZero(const FlowFacts &facts, const BinaryOperation &relation, std::uint32_t variable) {
  const auto limit = literalValue(*facts.file.tree, relation.right);
  if (!limit || variableNumber(*facts.file.tree, unwrapped(*facts.file.tree, relation.left)) != variable)
    return false;
  return ((relation.op == OperatorKind::LessOrEqual || relation.op == OperatorKind::Equal) && limit->isZero()) ||
         (relation.op == OperatorKind::LessThan && *limit == Decimal(1, 0));
}

/// The next block behind the test raises an alarm, or the test leads to one.
bool raisesWhenTrue(const FlowFacts &facts, NodeId test) {
  const BlockId behind = facts.node(test).block.next();
  const bool isLoop = std::ranges::any_of(facts.file.model->loops,
                                          [&](const Loop &loop) { return loop.doBlock == facts.node(test).block; });
  return isLoop ? raisesAlarmAt(facts.file, behind) : alarmWhenTrue(facts, test) == true;
}

/// Behind the call, and with the value that was passed.
std::optional<ExpressionId> checkBehind(const FlowFacts &facts, NodeId call, std::uint32_t variable) {
  for (NodeId node = call.next(); node < facts.end(); node = node.next()) {
    if (assignmentTo(facts, node, variable))
      return std::nullopt;
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto *relation = test && test->condition && facts.isReached(node)
                               ? asInside<BinaryOperation>(*facts.file.tree, *test->condition)
                               : nullptr;
    if (relation && refusesZero(facts, *relation, variable) && raisesWhenTrue(facts, node) &&
        isPassedAlways(facts, call, node))
      return *test->condition;
  }
  return std::nullopt;
}

bool isTestedBefore(const FlowFacts &facts, BlockId call, std::uint32_t variable) {
  return std::ranges::any_of(readsOf(facts), [&](const Read &read) {
    return read.number == variable && read.block < call &&
           (read.use == ReadUse::Equality || read.use == ReadUse::Ordering);
  });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *instruction = std::get_if<CallProgram>(&facts.node(node).instruction);
    if (!instruction || !facts.isReached(node))
      continue;
    const Call &call = context.model.calls[instruction->call];
    const auto callee = context.callGraph.callee(context.file, call);
    if (call.kind != CallKind::Macro || !callee)
      continue;
    for (const Argument &argument : call.arguments) {
      const Word &word = context.tree.words[argument.word];
      const auto variable = word.form() == WordForm::Expression ? variableOf(facts, word.expression()) : std::nullopt;
      const auto jump = variable ? jumpAtHead(facts, *callee, argument.variable) : std::nullopt;
      const auto late =
          jump && !isTestedBefore(facts, call.block, *variable) ? checkBehind(facts, node, *variable) : std::nullopt;
      if (!late)
        continue;
      reporter.report(
          {.message = fmt::format("{} comes too late: the called program has jumped to this number",
                                  context.quoted(context.tree.expressions[*late].span)),
           .span = context.tree.expressions[*late].span,
           .labels = {{word.span(), "passed here"}, {*jump, "jumps to it at once", callee->file}},
           .notes = {fmt::format("with a number that is wrong the control {} in the called program, and the "
                                 "alarm of this check is never raised",
                                 stopsWith(context.dialect, AlarmKind::SequenceNotFound)),
                     "move the check before the call"}});
    }
  }
}

} // namespace

extern const Rule checkBehindCall;
const Rule checkBehindCall{.info = {"check-behind-call", Category::Flow, Severity::Warning,
                                    "Reports a check of a value behind the call of a program that jumps to it."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules::check_behind_call
