// deviation-not-checked: `#104=ABS[#103-5.]`, which nothing reads, beside `#102=ABS[#101-10.]`, which a condition asks
// for.
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace feedhold::rules::deviation_not_checked {
namespace {

/// `ABS[#101-10.]`, of something that was measured from something that was wanted.
bool isDeviation(const FileContext &context, ExpressionId value) {
  const auto *function = asInside<FunctionCall>(context.tree, value);
  if (!function || function->function != FunctionKind::Abs || function->arguments().size() != 1)
    return false;
  const auto *difference = asInside<BinaryOperation>(context.tree, function->arguments().front());
  return difference && difference->op == OperatorKind::Subtract;
}

struct Deviation {
  std::uint32_t variable;
  Span span;
};

bool isReadInRun(const FlowFacts &facts, std::uint32_t variable) {
  return facts.programs.unnumberedUses().reads + facts.programs.usesOf(variable).reads != 0;
}

bool isCommon(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  return range && range->kind == VariableKind::Common;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  std::vector<Deviation> unread;
  std::optional<Deviation> tested;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    for (const Assignment &assignment : assignmentsOf(facts, node)) {
      const auto number = variableNumber(context.tree, unwrapped(context.tree, assignment.target));
      if (!number || !isCommon(context, *number) || !isDeviation(context, assignment.value))
        continue;
      const Deviation found{*number, context.tree.blocks[facts.node(node).block].span()};
      if (isTested(facts.file, facts.program, *number))
        tested = tested ? tested : found;
      else if (!isReadInRun(facts, *number))
        unread.push_back(found);
    }
  if (!tested || unread.empty())
    return;
  Diagnostic diagnostic{.message = fmt::format("nothing checks the deviation in `#{}`", unread.front().variable),
                        .span = unread.front().span,
                        .labels = {{tested->span, fmt::format("`#{}` is compared with a tolerance", tested->variable)}},
                        .notes = {"the measurement is made, and a part out of tolerance passes",
                                  "compare it as the other one, or take the measurement out"}};
  for (std::size_t i = 1; i < unread.size(); ++i)
    diagnostic.labels.push_back({unread[i].span, fmt::format("nor that in `#{}`", unread[i].variable)});
  reporter.report(std::move(diagnostic));
}

} // namespace

extern const Rule deviationNotChecked;
const Rule deviationNotChecked{.info = {"deviation-not-checked", Category::Flow, Severity::Warning,
                                        "Reports a deviation that is computed and never read, beside one that is "
                                        "compared with a tolerance."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::deviation_not_checked
