// check-behind-probe-alarm: `G38.2 Z-10`, and then `o1 if [#5070 EQ 0]`: without a contact the program has stopped.
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::check_behind_probe_alarm {
namespace {

constexpr std::uint32_t kContact = 5070; // 1 behind a probe that touched

/// `#5070EQ0`, `#5070NE1`: asks whether the probe has missed.
bool asksForMiss(const FileContext &context, ExpressionId part) {
  const auto *relation = as<BinaryOperation>(context.tree, part);
  if (!relation || variableNumber(context.tree, unwrapped(context.tree, relation->left)) != kContact)
    return false;
  const auto value = literalValue(context.tree, relation->right);
  return value && ((relation->op == OperatorKind::Equal && value->isZero()) ||
                   (relation->op == OperatorKind::NotEqual && *value == Decimal(1, 0)));
}

struct Probe {
  const Word *last = nullptr; // before the place
  bool hasOther = false;      // one that goes on without a contact
};

Probe probeBefore(const FileContext &context, ProgramId program, BlockId place) {
  Probe probe;
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    for (const Word &word : context.tree.wordsOf(block)) {
      const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr;
      if (!code || !isSkip(code->role))
        continue;
      probe.hasOther = probe.hasOther || code->role == CodeRole::Skip;
      if (block < place)
        probe.last = &word;
    }
  return probe;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.grammar.oWords)
    return;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition || !facts.isReached(node))
      continue;
    const auto parts = subexpressions(context.tree, *test->condition);
    if (std::ranges::none_of(parts, [&](ExpressionId part) { return asksForMiss(context, part); }))
      continue;
    const Probe probe = probeBefore(context, facts.program, facts.node(node).block);
    if (!probe.last || probe.hasOther || probe.last->tenths() == 384U)
      continue;
    const Span condition = context.tree.expressions[*test->condition].span;
    reporter.report({.message = fmt::format("{} is never true: {} stops the program when the probe touches nothing",
                                            context.quoted(condition), context.quoted(probe.last->span())),
                     .span = condition,
                     .labels = {{probe.last->span(), "the probe"}},
                     .notes = {"what is written for this case is never executed",
                               "probe with `G38.3`, which goes on, or leave the check out"}});
    return;
  }
}

} // namespace

extern const Rule checkBehindProbeAlarm;
const Rule checkBehindProbeAlarm{
    .info = {"check-behind-probe-alarm", Category::Motion, Severity::Info,
             "Reports a check for a missed touch behind a probe move that stops the program "
             "by itself."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::check_behind_probe_alarm
