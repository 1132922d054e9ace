// loop-counter-clobbered: an inner loop steps the counter of the outer one, too.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::loop_counter_clobbered {
namespace {

/// `#1 = #1 + ..`, `#1 = #1 - ..`
bool isStep(const VariableUse &use, const FileContext &context) {
  for (const Statement &statement : context.tree.statementsOf(use.block)) {
    const auto *assignment = std::get_if<Assignment>(&statement.node);
    if (!assignment || assignment->target != use.expression)
      continue;
    const auto *sum =
        std::get_if<BinaryOperation>(&context.tree.expressions[unwrapped(context.tree, assignment->value)].node);
    return sum && (sum->op == OperatorKind::Add || sum->op == OperatorKind::Subtract) &&
           (variableNumber(context.tree, unwrapped(context.tree, sum->left)) == use.number ||
            variableNumber(context.tree, unwrapped(context.tree, sum->right)) == use.number);
  }
  return false;
}

std::vector<std::uint32_t> testedBy(const Loop &loop, const FileContext &context) {
  std::vector<std::uint32_t> tested;
  for (const Statement &statement : context.tree.statementsOf(loop.doBlock))
    if (const auto *loopHead = std::get_if<While>(&statement.node); loopHead && loopHead->condition)
      for (const ExpressionId id : subexpressions(context.tree, *loopHead->condition))
        if (const auto number = variableNumber(context.tree, id))
          tested.push_back(*number);
  return tested;
}

const VariableUse *stepOf(std::uint32_t variable, BlockId first, BlockId last, const FileContext &context) {
  for (const VariableUse &use : context.model.variablesIn(first, last))
    if (use.write && use.number == variable && isStep(use, context))
      return &use;
  return nullptr;
}

const VariableUse *stepOutsideOf(std::uint32_t variable, const Loop &outer, const Loop &inner,
                                 const FileContext &context) {
  const VariableUse *before = stepOf(variable, outer.doBlock, inner.doBlock, context);
  return before ? before : stepOf(variable, inner.endBlock->next(), outer.endBlock->next(), context);
}

void checkPair(const Loop &outer, const Loop &inner, const FileContext &context, const Reporter &reporter) {
  const std::vector<std::uint32_t> inInner = testedBy(inner, context);
  for (const std::uint32_t variable : testedBy(outer, context)) {
    if (inInner.empty() || std::ranges::find(inInner, variable) != inInner.end())
      continue;
    const VariableUse *own = stepOutsideOf(variable, outer, inner, context);
    const VariableUse *other = stepOf(variable, inner.doBlock, inner.endBlock->next(), context);
    if (!own || !other)
      continue;
    const Span place = context.tree.expressions[other->expression].span;
    return reporter.report(
        {.message = fmt::format("the inner loop also steps {}, the counter of the outer loop", context.quoted(place)),
         .span = place,
         .labels = {{context.tree.statements[outer.doStatement].span, "the outer loop counts with it"},
                    {context.tree.expressions[own->expression].span, "the step of the outer loop"}},
         .notes = {"the outer loop leaves out the levels that the inner loop has stepped over",
                   "give the inner loop its own counter"}});
  }
}

void check(const FileContext &context, const Reporter &reporter) {
  for (const Loop &outer : context.model.loops)
    for (const Loop &inner : context.model.loops)
      if (outer.endBlock && inner.endBlock && outer.doBlock < inner.doBlock && *inner.endBlock < *outer.endBlock)
        checkPair(outer, inner, context, reporter);
}

} // namespace

extern const Rule loopCounterClobbered;
const Rule loopCounterClobbered{.info = {"loop-counter-clobbered", Category::Motion, Severity::Warning,
                                         "Reports an inner loop that steps the counter of the outer loop as well."},
                                .hooks = {.file = check}};

} // namespace feedhold::rules::loop_counter_clobbered
