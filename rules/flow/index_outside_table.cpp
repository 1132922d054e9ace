// index-outside-table: `#[5221+[#23-54]*20]` in the branch for negative `#23`.
#include "rules/flow/definitions.h"
#include "rules/flow/passed_values.h"
#include "rules/flow/system_variables.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::index_outside_table {
namespace {

/// Tables whose numbers are computed from an axis and an offset.
bool isComputedTable(VariableRole role) {
  constexpr std::array kTables = {VariableRole::WorkOffset,      VariableRole::AdditionalWorkOffset,
                                  VariableRole::MachinePosition, VariableRole::WorkPosition,
                                  VariableRole::SkipPosition,    VariableRole::BlockEndPosition};
  return std::ranges::find(kTables, role) != kTables.end();
}

/// The first and the last number of the table, with all its parts.
VariableSpan tableOf(const Dialect &dialect, VariableRole role) {
  VariableSpan span{kFirstNamedVariable, 0};
  for (const VariableRange &range : dialect.variables)
    if (range.role == role && range.kind == VariableKind::System)
      span = {std::min(span.first, range.first), std::max(span.last, range.last)};
  return span;
}

struct Outside {
  const VariableUse *use;
  VariableSpan table;
  bool isBelow;
  double nearest;
  bool isNamedOnce = false; // by the largest of the values
};

/// `#[7001+[1+#23]*20]` behind a test for negative `#23`: only the largest value may name the first entry of the table,
/// all others lie below.
bool fallsFromFirst(const Interval &numbers, const VariableSpan &table) {
  constexpr double kStep = 20;       // from one offset to the next
  constexpr double kFarBelow = 1000; // the analysis knows no lower bound
  return numbers.hi <= table.first + kStep + 2 && numbers.lo < table.first - kFarBelow;
}

std::optional<Outside> outsideAt(const FlowFacts &facts, const FileContext &context, const VariableUse &use) {
  const auto *indirect = as<IndirectVariable>(context.tree, use.expression);
  const auto base = indirect ? tableNumber(context, use.expression) : std::nullopt;
  const VariableRole role = base ? roleOf(context, *base) : VariableRole::Plain;
  const AbstractValue *index = isComputedTable(role) ? facts.valueOf(indirect->index) : nullptr;
  if (!index || !index->mayBeNumber())
    return std::nullopt;
  const VariableSpan table = tableOf(context.dialect, role);
  const Interval &numbers = index->number().interval();
  if (numbers.hi < table.first)
    return Outside{&use, table, true, numbers.hi};
  if (fallsFromFirst(numbers, table) && *base >= table.first)
    return Outside{&use, table, true, numbers.hi, true};
  return numbers.lo >= static_cast<double>(table.last) + 1 ? std::optional(Outside{&use, table, false, numbers.lo})
                                                           : std::nullopt;
}

/// One finding for consecutive blocks: X, Y and Z of one offset.
void checkTables(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::vector<Outside> all;
  for (const VariableUse &use : context.model.variablesOf(facts.program))
    if (const auto outside = outsideAt(facts, context, use))
      all.push_back(*outside);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Outside &first = all[i];
    const Span span = context.tree.expressions[first.use->expression].span;
    const auto node = nodeOf(facts, first.use->block, first.use->expression);
    Diagnostic diagnostic{
        .message =
            fmt::format("{} {} a variable of the table from `#{}` to `#{}`", context.quoted(span),
                        first.isNamedOnce ? "hardly ever names" : "never names", first.table.first, first.table.last),
        .span = span,
        .flow = node ? pathFromEntry(facts, *node) : std::vector<Label>{},
        .notes = {first.isNamedOnce
                      ? std::string("on this path the number falls from the first entry of the table on: all others "
                                    "are variables below it, which the control uses without an alarm")
                      : fmt::format("on this path the number is {} {:g}, {} the table",
                                    first.isBelow ? "at most" : "at least", first.nearest,
                                    first.isBelow ? "below" : "behind"),
                  first.isNamedOnce ? "correct the sign of the factor for this branch"
                                    : "correct the base or the factor for this branch"}};
    for (; i + 1 < all.size() && all[i + 1].use->block.index() - all[i].use->block.index() <= 1; ++i)
      diagnostic.labels.push_back({context.tree.expressions[all[i + 1].use->expression].span, "nor does this"});
    reporter.report(std::move(diagnostic));
  }
}

/// On each path to the node a test of the variable leads to an alarm: its range is checked.
bool isRangeChecked(const FlowFacts &facts, std::uint32_t variable, NodeId at) {
  return std::ranges::any_of(testsBefore(facts, at), [&](const PassedTest &test) {
    const BlockId block = facts.node(test.node).block;
    return leadsToAlarm(facts, block) && std::ranges::any_of(readsOf(facts.file, block), [&](const Read &read) {
             return read.number == variable && read.use == ReadUse::Ordering;
           });
  });
}

/// An expression, and the node that evaluates it.
struct Computed {
  ExpressionId expression;
  NodeId node;
};

/// Of `#[#5]` behind `#5=2000+#20`, the sum.
Computed computedIndex(const FlowFacts &facts, const FileContext &context, ExpressionId index, NodeId node) {
  const auto variable = variableOf(facts, unwrapped(context.tree, index));
  const auto known = variable ? definitionsOf(facts, *variable, node) : std::nullopt;
  const auto assignment = known && !known->fromEntry && known->nodes.size() == 1
                              ? assignmentTo(facts, known->nodes.front(), *variable)
                              : std::nullopt;
  return assignment ? Computed{assignment->value, known->nodes.front()} : Computed{index, node};
}

/// `IF[#1LT1]GOTO90`, then `#[500+#1]`: the argument that is checked below only.
std::optional<std::uint32_t> checkedBelowOnly(const FlowFacts &facts, const FileContext &context,
                                              const Computed &computed, const Interval &numbers) {
  constexpr double kAnyNumber = 1e6; // beyond it no test has set a bound
  const auto reads = readsIn(facts.file, computed.expression, facts.node(computed.node).block);
  const auto argument = reads.size() == 1 ? reads.front().number : std::nullopt;
  const bool isOpen = argument && numbers.lo > -kAnyNumber && numbers.hi > kAnyNumber &&
                      isParameter(facts, *argument) && argumentBehind(facts, *argument) == argument &&
                      !isMainProgram(facts) && !mayHoldCallersValue(facts, *argument) &&
                      passedFor(*argument, facts, context).zero != PassedZero::Never;
  return isOpen ? argument : std::nullopt;
}

struct OpenIndex {
  std::uint32_t argument;
  bool isBelow; // has no lower bound; else no upper one
};

/// `IF[#1GT20]GOTO90`, then `#[500+#1]`: the argument that is checked on one side only.
std::optional<OpenIndex> unboundedIndex(const FlowFacts &facts, const FileContext &context, const VariableUse &use) {
  const auto *indirect = as<IndirectVariable>(context.tree, use.expression);
  const AbstractValue *index = indirect ? facts.valueOf(indirect->index) : nullptr;
  const auto node =
      index && index->number().interval().hi >= 0 ? nodeOf(facts, use.block, use.expression) : std::nullopt;
  if (!node)
    return std::nullopt;
  const Computed computed = computedIndex(facts, context, indirect->index, *node);
  const bool hasBase = std::ranges::any_of(subexpressions(context.tree, computed.expression), [&](ExpressionId part) {
    const auto base = literalValue(context.tree, part);
    return base && *base > Decimal(kLocalVariables, 0);
  });
  if (!hasBase)
    return std::nullopt;
  const auto below = checkedAboveOnly(facts, context, computed.node, computed.expression, *index);
  const auto above = below ? std::nullopt : checkedBelowOnly(facts, context, computed, index->number().interval());
  const auto argument = below ? below : above;
  return argument && isRangeChecked(facts, *argument, *node) ? std::optional(OpenIndex{*argument, below.has_value()})
                                                             : std::nullopt;
}

void checkBounds(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::set<std::uint32_t> done;
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    const auto open = unboundedIndex(facts, context, use);
    if (!open || !done.insert(open->argument).second)
      continue;
    const Span span = context.tree.expressions[use.expression].span;
    Diagnostic diagnostic{
        .message = fmt::format("nothing checks the {} bound of {}: {} may be a variable {} the table",
                               open->isBelow ? "lower" : "upper", describeVariable(context.dialect, open->argument),
                               context.quoted(span), open->isBelow ? "before" : "behind"),
        .span = span,
        .notes = {open->isBelow ? "if it is negative or not passed, the control uses another variable, without an alarm"
                                : "if it is too large, the control uses another variable, without an alarm",
                  open->isBelow ? "check the lower bound as well, and that the argument was passed"
                                : "check the upper bound as well"}};
    addPassed(diagnostic, passedFor(open->argument, facts, context), facts);
    reporter.report(std::move(diagnostic), open->isBelow ? Severity::Warning : Severity::Info);
  }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  checkTables(facts, context, reporter);
  checkBounds(facts, context, reporter);
}

} // namespace

extern const Rule indexOutsideTable;
const Rule indexOutsideTable{
    .info = {"index-outside-table", Category::Flow, Severity::Warning,
             "Reports a computed variable number that lies outside of its table, or is checked on one side only."},
    .hooks = {.flow = check, .flowRuns = FlowRuns::All}};

} // namespace feedhold::rules::index_outside_table
