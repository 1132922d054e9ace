// time-since-power-on: `IF[#3001GT1800]GOTO99`, and nothing sets `#3001` to 0.
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::time_since_power_on {
namespace {

constexpr std::uint32_t kMilliseconds = 3001;
constexpr std::int64_t kHour = 3'600'000;

bool isSetInRun(const FlowFacts &facts) {
  return facts.programs.unnumberedUses().writes + facts.programs.usesOf(kMilliseconds).writes != 0;
}

/// `#3001GT1800`: the time that it is compared with.
std::optional<Decimal> timeIn(const FileContext &context, ExpressionId part) {
  const auto *relation = as<BinaryOperation>(context.tree, part);
  if (!relation || !isRelation(relation->op))
    return std::nullopt;
  for (const auto &[clock, time] :
       {std::pair{relation->left, relation->right}, std::pair{relation->right, relation->left}})
    if (variableNumber(context.tree, unwrapped(context.tree, clock)) == kMilliseconds)
      return literalValue(context.tree, time);
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (roleOf(context, kMilliseconds) != VariableRole::Clock || isSetInRun(facts) ||
      !context.model.callsOf(facts.program).empty())
    return;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition || !facts.isReached(node))
      continue;
    for (const ExpressionId part : subexpressions(context.tree, *test->condition)) {
      const auto time = timeIn(context, part);
      if (!time || *time >= Decimal(kHour, 0))
        continue;
      const Span span = context.tree.expressions[part].span;
      reporter.report(
          {.message = fmt::format("{} compares the time since the control was switched on", context.quoted(span)),
           .span = span,
           .notes = {"`#3001` counts milliseconds, and nothing in the checked programs sets it: it is "
                     "beyond this number soon after power-on",
                     "write `#3001=0` where the time begins; `#3002` counts hours"}});
      return;
    }
  }
}

} // namespace

extern const Rule timeSincePowerOn;
const Rule timeSincePowerOn{.info = {"time-since-power-on", Category::Flow, Severity::Warning,
                                     "Reports a comparison of the millisecond timer that no program sets to 0."},
                            .hooks = {.flow = check}};

} // namespace feedhold::rules::time_since_power_on
