// computed-goto-target: `GOTO#1` to a number that no block has.
#include "rules/flow/passed_values.h"

#include <cmath>
#include <fmt/format.h>

namespace feedhold::rules::computed_goto_target {
namespace {

/// Of few possible values those that are no sequence number of the program.
std::vector<double> missingOf(const FlowFacts &facts, const AbstractValue &target) {
  std::vector<double> missing;
  for (const double value : target.number().set().values()) {
    const double rounded = std::floor(value + 0.5);
    const bool isNumber = rounded >= 0 && rounded < 1e9;
    if (!isNumber || facts.file.model->find(facts.program, static_cast<std::uint32_t>(rounded)).empty())
      missing.push_back(value);
  }
  return missing;
}

void reportUnchecked(std::uint32_t argument, ExpressionId target, const FlowFacts &facts, const FileContext &context,
                     const Reporter &reporter) {
  const Span span = context.tree.expressions[target].span;
  Diagnostic diagnostic{
      .message = fmt::format("nothing checks the lower bound of {}: {} may be no sequence number of this program",
                             describeVariable(context.dialect, argument), context.quoted(span)),
      .span = span,
      .notes = {fmt::format("if it is 0, negative or not passed, the control {}",
                            stopsWith(context.dialect, AlarmKind::SequenceNotFound)),
                fmt::format("check the lower bound as well, as in `IF[#{} LT 1]`", argument)}};
  addPassed(diagnostic, passedFor(argument, facts, context), facts);
  reporter.report(std::move(diagnostic), Severity::Warning);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *jump = std::get_if<JumpTo>(&facts.node(node).instruction);
    const AbstractValue *target = jump && facts.isReached(node) ? facts.valueOf(jump->target) : nullptr;
    if (!target)
      continue;
    if (const auto argument = checkedAboveOnly(facts, context, node, jump->target, *target)) {
      reportUnchecked(*argument, jump->target, facts, context, reporter);
      continue;
    }
    if (!target->isNumber() || target->number().set().isMany())
      continue;
    const auto missing = missingOf(facts, *target);
    if (missing.empty())
      continue;
    const Span span = context.tree.expressions[jump->target].span;
    const bool always = missing.size() == target->number().set().values().size();
    Diagnostic diagnostic{
        .message = fmt::format("{} {} {:.6g} here, but this program has no `N{:.6g}`", context.quoted(span),
                               always ? "is" : "can be", missing.front(), missing.front()),
        .span = span,
        .flow = pathFromEntry(facts, node),
        .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::SequenceNotFound)),
                  "correct the computation, or add the sequence number"}};
    if (always)
      reporter.report(std::move(diagnostic));
    else
      reporter.report(std::move(diagnostic), Severity::Warning);
  }
}

} // namespace

extern const Rule computedGotoTarget;
const Rule computedGotoTarget{
    .info = {"computed-goto-target", Category::Flow, Severity::Error,
             "Reports a computed `GOTO` to a sequence number that the program does not have."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::computed_goto_target
