// vacant-passes-guard: `IF[#1EQ0]` lets an argument through that was not passed, as `IF[#1NE0]` past the alarm does.
#include "rules/flow/common_table.h"
#include "rules/flow/definitions.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace feedhold::rules::vacant_passes_guard {
namespace {

/// `#18EQ0` or `0EQ#18`, `#18NE0`: the variable.
std::optional<ExpressionId> comparedWithZero(const SyntaxTree &tree, const BinaryOperation &relation) {
  if (relation.op != OperatorKind::Equal && relation.op != OperatorKind::NotEqual)
    return std::nullopt;
  for (const auto &[variable, zero] :
       {std::pair{relation.left, relation.right}, std::pair{relation.right, relation.left}})
    if (const auto value = literalValue(tree, zero);
        value && value->isZero() && variableNumber(tree, unwrapped(tree, variable)))
      return unwrapped(tree, variable);
  return std::nullopt;
}

enum class OtherComparison : std::uint8_t { Any, WithLiteral };

/// Some comparison in the program refuses the vacant variable as well: with `#0`, or `LE 0`, `LT 1`.
bool isRefusedElsewhere(const FlowFacts &facts, std::uint32_t variable, OtherComparison which = OtherComparison::Any) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto isOther = [&](ExpressionId id) {
    const auto *relation = as<BinaryOperation>(tree, id);
    if (!relation || !isRelation(relation->op) || comparedWithZero(tree, *relation))
      return false;
    const auto left = variableNumber(tree, unwrapped(tree, relation->left));
    const auto right = variableNumber(tree, unwrapped(tree, relation->right));
    const auto other = left == variable ? right : left;
    return (left == variable || right == variable) &&
           (which == OtherComparison::Any || !other || other == kVacantVariable);
  };
  for (const VariableUse &use : facts.file.model->variablesOf(facts.program))
    if (use.number == variable && !use.write) {
      const auto all = expressionsOf(facts.file, use.block);
      if (std::ranges::any_of(all, isOther))
        return true;
    }
  return false;
}

/// `IF[#13EQ0]THEN#13=5.`, and nothing else sets the variable: a default that a missing argument does not get.
bool givesDefault(const FlowFacts &facts, BlockId block, std::uint32_t variable) {
  const auto uses = facts.file.model->variablesOf(facts.program);
  const auto sets = [&](const VariableUse &use) { return use.write && use.number == variable; };
  return letterOfArgument(*facts.file.dialect, variable) && std::ranges::count_if(uses, sets) == 1 &&
         std::ranges::any_of(facts.file.model->variablesIn(block, block.next()), sets);
}

/// The same for a common variable that the operator may set: no other block of the run sets it.
bool givesCommonDefault(const FlowFacts &facts, const FileContext &context, BlockId block, std::uint32_t variable) {
  const VariableRange *range = findVariable(context.dialect, variable);
  if (!range || (range->kind != VariableKind::Common && range->kind != VariableKind::Retentive) ||
      isPromised(facts, context, variable) || isRefusedElsewhere(facts, variable, OtherComparison::WithLiteral))
    return false;
  return facts.programs.unnumberedUses().writes + facts.programs.usesOf(variable).writes == 1 &&
         std::ranges::any_of(facts.file.model->variablesIn(block, block.next()),
                             [&](const VariableUse &use) { return use.write && use.number == variable; });
}

/// A common variable that the operator sets, as far as the checked programs show.
bool isSetByOperator(const FlowFacts &facts, const FileContext &context, std::uint32_t variable, BlockId block) {
  const VariableRange *range = findVariable(context.dialect, variable);
  if (!range || (range->kind != VariableKind::Common && range->kind != VariableKind::Retentive) ||
      isPromised(facts, context, variable) || isWrittenInAny(facts, variable))
    return false;
  const auto calls = context.model.callsOf(facts.program);
  return std::ranges::none_of(calls, [&](const Call &call) {
    return call.block < block &&
           (!context.callGraph.callee(context.file, call) || context.callGraph.reachesEncrypted(context.file, call));
  });
}

enum class GuardKind : std::uint8_t { Alarm, Default, CommonDefault, Operator, Division, Table };

struct Guard {
  Span span;
  std::uint32_t variable;
  GuardKind kind;
  bool isNotEqual = false; // `IF[#18NE0]GOTO5` jumps past the alarm
  Span division = {};      // the divisor that it should protect
};

/// The comparison lets the variable pass that it is to stop.
std::optional<Guard> passingGuard(const FlowFacts &facts, const FileContext &context, NodeId test, ExpressionId part) {
  const BlockId block = facts.node(test).block;
  const auto *relation = as<BinaryOperation>(context.tree, part);
  const auto variable = relation ? comparedWithZero(context.tree, *relation) : std::nullopt;
  const AbstractValue *value = variable ? facts.valueOf(*variable) : nullptr;
  const auto number = variable ? variableNumber(context.tree, *variable) : std::nullopt;
  if (!value || !value->mayBeVacant() || !value->mayBeNumber())
    return std::nullopt;
  const bool isNotEqual = relation->op == OperatorKind::NotEqual;
  if (!isNotEqual && givesCommonDefault(facts, context, block, *number))
    return Guard{context.tree.expressions[part].span, *number, GuardKind::CommonDefault};
  if (isRefusedElsewhere(facts, *number))
    return std::nullopt;
  if (isNotEqual && alarmWhenTrue(facts, test) != false)
    return std::nullopt;
  const Span span = context.tree.expressions[part].span;
  if (!isLocal(facts.file, *number))
    return (isNotEqual || leadsToAlarm(facts, block)) && isSetByOperator(facts, context, *number, block)
               ? std::optional(Guard{span, *number, GuardKind::Operator, isNotEqual})
               : std::nullopt;
  if (isMainProgram(facts) || mayHoldCallersValue(facts, *number))
    return std::nullopt;
  if (!isNotEqual && givesDefault(facts, block, *number))
    return Guard{span, *number, GuardKind::Default};
  return (isNotEqual || leadsToAlarm(facts, block)) && argumentBehind(facts, *number)
             ? std::optional(Guard{span, *number, GuardKind::Alarm, isNotEqual})
             : std::nullopt;
}

/// `IF[#7EQ0]GOTO9`, then `5./#7`: the test that keeps 0 from the divisor, and lets the vacant variable through.
std::optional<Guard> guardOfDivision(const FlowFacts &facts, const FileContext &context, const AlarmFact &alarm) {
  const BlockId block = facts.node(alarm.node).block;
  const auto divisor = expressionAt(facts, block, alarm.place);
  const auto variable = divisor ? variableNumber(context.tree, unwrapped(context.tree, *divisor)) : std::nullopt;
  const AbstractValue *value = variable ? facts.valueOf(*divisor) : nullptr;
  if (!value || !value->mayBeVacant() || !value->mayBeNumber() || isRefusedElsewhere(facts, *variable))
    return std::nullopt;
  const auto known = definitionsOf(facts, *variable, alarm.node);
  if (!known || !known->fromEntry || !known->nodes.empty())
    return std::nullopt;
  for (const PassedTest &passed : testsBefore(facts, alarm.node)) {
    const auto *test = std::get_if<Test>(&facts.node(passed.node).instruction);
    const auto *relation =
        test && test->condition ? asInside<BinaryOperation>(context.tree, *test->condition) : nullptr;
    const auto asked = relation ? comparedWithZero(context.tree, *relation) : std::nullopt;
    const bool passesZero = relation && passed.isTrue == (relation->op == OperatorKind::Equal);
    if (!asked || passesZero || variableNumber(context.tree, *asked) != variable)
      continue;
    const bool isOpen = isLocal(facts.file, *variable)
                            ? !isMainProgram(facts) && !mayHoldCallersValue(facts, *variable) &&
                                  argumentBehind(facts, *variable) && !isAlwaysPassed(facts, *variable)
                            : isSetByOperator(facts, context, *variable, block);
    if (isOpen && !alarmWhenTrue(facts, passed.node))
      return Guard{context.tree.expressions[unwrapped(context.tree, *test->condition)].span, *variable,
                   GuardKind::Division, relation->op == OperatorKind::NotEqual, alarm.place};
  }
  return std::nullopt;
}

/// Some condition tells vacant from a number: `EQ #0`, or an order with a literal, for which vacant is 0.
bool isVacancySeen(const FlowFacts &facts, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto sees = [&](ExpressionId id) {
    const auto *relation = as<BinaryOperation>(tree, id);
    if (!relation || !isRelation(relation->op))
      return false;
    const bool isEquality = relation->op == OperatorKind::Equal || relation->op == OperatorKind::NotEqual;
    for (const auto &[own, other] :
         {std::pair{relation->left, relation->right}, std::pair{relation->right, relation->left}})
      if (variableNumber(tree, unwrapped(tree, own)) == variable &&
          (isEquality ? variableNumber(tree, unwrapped(tree, other)) == kVacantVariable
                      : literalValue(tree, other).has_value()))
        return true;
    return false;
  };
  return std::ranges::any_of(blocksOf(facts.file, facts.program), [&](BlockId block) {
    return std::ranges::any_of(expressionsOf(facts.file, block), sees);
  });
}

/// `#[550+#1]=0` in the file: the whole table is set before.
bool isFilledHere(const FlowFacts &facts, const FileContext &context, std::uint32_t base) {
  return std::ranges::any_of(context.model.variables, [&](const VariableUse &use) {
    return use.write && !use.number && tableBase(facts, use.expression) == base;
  });
}

/// Some common variables are cleared to vacant at power-off; where all are kept, an unused one is shown as 0.
bool clearsToVacant(const Dialect &dialect) {
  return std::ranges::find(dialect.variables, VariableKind::Common, &VariableRange::kind) != dialect.variables.end();
}

/// `#3=#[550+#1]`, `IF[#3EQ0]THEN M99`, and then a computation or an order with #3: an entry that nobody has filled is
/// vacant, and passes the test.
std::optional<Guard> guardOfTable(const FlowFacts &facts, const FileContext &context, NodeId test, ExpressionId part) {
  const auto *relation = as<BinaryOperation>(context.tree, part);
  const bool isAsked = relation && relation->op == OperatorKind::Equal && clearsToVacant(context.dialect);
  const auto compared = isAsked ? comparedWithZero(context.tree, *relation) : std::nullopt;
  const auto variable = compared ? variableNumber(context.tree, *compared) : std::nullopt;
  const auto known = variable ? definitionsOf(facts, *variable, test) : std::nullopt;
  if (!known || known->fromEntry || known->nodes.size() != 1)
    return std::nullopt;
  const auto read = assignmentTo(facts, known->nodes.front(), *variable);
  const auto base = read ? tableBase(facts, read->value) : std::nullopt;
  const VariableRange *range = base ? findVariable(context.dialect, *base) : nullptr;
  if (!range || (range->kind != VariableKind::Common && range->kind != VariableKind::Retentive) ||
      isVacancySeen(facts, *variable) || isFilledHere(facts, context, *base))
    return std::nullopt;
  const auto isUsedBehind = [&](const Read &each) {
    return each.number == variable && each.block > facts.node(test).block &&
           (each.use == ReadUse::Ordering || each.use == ReadUse::Computed);
  };
  return std::ranges::any_of(readsOf(facts), isUsedBehind)
             ? std::optional(Guard{context.tree.expressions[part].span, *variable, GuardKind::Table})
             : std::nullopt;
}

std::string describe(const FileContext &context, const Guard &guard) {
  if (guard.kind == GuardKind::Table)
    return "vacant entry of the table";
  return guard.variable > kLocalVariables
             ? fmt::format("vacant `#{}`", guard.variable)
             : fmt::format("missing {}", describeVariable(context.dialect, guard.variable));
}

std::vector<std::string> notesFor(const Guard &guard, const FileContext &context) {
  const std::string test = fmt::format("`[#{} EQ #0]`", guard.variable);
  if (guard.kind == GuardKind::Division)
    return {fmt::format("`EQ` and `NE` tell vacant from 0, a division does not: there the control {}",
                        stopsWith(context.dialect, AlarmKind::DivideByZero)),
            fmt::format("check {} as well", test)};
  if (guard.kind == GuardKind::Table)
    return {"a common variable that nobody has set is vacant, and `EQ` does not treat vacant as 0: what follows "
            "computes with it as 0",
            fmt::format("check {} as well", test)};
  if (guard.isNotEqual)
    return {"`NE` tells vacant from 0: the jump past the alarm is taken", fmt::format("check {} as well", test)};
  if (guard.kind == GuardKind::CommonDefault)
    return {
        "a common variable that nobody has set is vacant, and `EQ` does not treat vacant as 0: it does not get this "
        "value",
        fmt::format("check {} as well", test)};
  if (guard.kind == GuardKind::Operator)
    return {"a common variable that nobody has set is vacant, and `EQ` does not treat vacant as 0: no alarm is raised",
            fmt::format("check {} as well", test)};
  const std::string why = "an argument that is not passed is vacant, and `EQ` does not treat vacant as 0: ";
  if (guard.kind == GuardKind::Default)
    return {why + "it does not get this value", fmt::format("check {} instead", test)};
  return {why + "no alarm is raised", fmt::format("check {} as well", test)};
}

/// One finding for all guards of one kind in a program.
void tell(const std::vector<Guard> &guards, const FileContext &context, const Reporter &reporter) {
  const Guard &first = guards.front();
  Diagnostic diagnostic{.message =
                            fmt::format("{} does not catch a {}", context.quoted(first.span), describe(context, first)),
                        .span = first.span,
                        .notes = notesFor(first, context)};
  if (first.kind == GuardKind::Division)
    diagnostic.labels.push_back({first.division, "divides by it"});
  for (std::size_t i = 1; i < guards.size(); ++i)
    diagnostic.labels.push_back({guards[i].span, fmt::format("nor this a {}", describe(context, guards[i]))});
  reporter.report(std::move(diagnostic));
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.behaviour.variablesMayBeVacant)
    return;
  std::map<GuardKind, std::vector<Guard>> guards;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition || !facts.isReached(node))
      continue;
    for (const ExpressionId part : subexpressions(context.tree, *test->condition))
      if (const auto guard = passingGuard(facts, context, node, part))
        guards[guard->kind].push_back(*guard);
      else if (const auto table = guardOfTable(facts, context, node, part))
        guards[table->kind].push_back(*table);
  }
  for (const AlarmFact &alarm : facts.alarms())
    if (alarm.kind == AlarmKind::DivideByZero && !alarm.always)
      if (const auto guard = guardOfDivision(facts, context, alarm))
        if (auto &same = guards[guard->kind];
            std::ranges::none_of(same, [&](const Guard &each) { return each.span == guard->span; }))
          same.push_back(*guard);
  for (const auto &[kind, found] : guards)
    tell(found, context, reporter);
}

} // namespace

extern const Rule vacantPassesGuard;
const Rule vacantPassesGuard{
    .info =
        {"vacant-passes-guard", Category::Flow, Severity::Warning,
         "Reports a check or a default by `EQ 0` or `NE 0` that does not catch a vacant argument or common variable."},
    .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::vacant_passes_guard
