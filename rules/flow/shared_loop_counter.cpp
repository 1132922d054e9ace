// shared-loop-counter: an inner loop steps the counter of the outer loop as well.
#include "findings/rule/rule.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::shared_loop_counter {
namespace {

struct Step {
  Span statement; // `#1=#1-.5`
  Span target;    // `#1`
};

/// `#1=#1+..`, `#1=#1-..`, `#1=..+#1`
std::optional<Step> stepIn(const Statement &statement, std::uint32_t variable, const SyntaxTree &tree) {
  const auto *assignment = std::get_if<Assignment>(&statement.node);
  if (!assignment || variableNumber(tree, unwrapped(tree, assignment->target)) != variable)
    return std::nullopt;
  const auto *sum = std::get_if<BinaryOperation>(&tree.expressions[unwrapped(tree, assignment->value)].node);
  const bool isStep = sum && (sum->op == OperatorKind::Add || sum->op == OperatorKind::Subtract) &&
                      (variableNumber(tree, unwrapped(tree, sum->left)) == variable ||
                       variableNumber(tree, unwrapped(tree, sum->right)) == variable);
  return isStep ? std::optional(Step{statement.span, tree.expressions[assignment->target].span}) : std::nullopt;
}

std::optional<Step> firstStep(std::uint32_t variable, BlockId first, BlockId last, const SyntaxTree &tree) {
  for (BlockId block = first; block < last; block = block.next())
    for (const Statement &statement : tree.statementsOf(block))
      if (const auto step = stepIn(statement, variable, tree))
        return step;
  return std::nullopt;
}

std::optional<Step> stepOutsideOf(const Loop &inner, std::uint32_t variable, const Loop &outer,
                                  const SyntaxTree &tree) {
  const auto before = firstStep(variable, outer.doBlock, inner.doBlock, tree);
  return before ? before : firstStep(variable, inner.endBlock->next(), outer.endBlock->next(), tree);
}

/// In the condition of its WHILE.
std::vector<std::uint32_t> testedBy(const Loop &loop, const SyntaxTree &tree) {
  std::vector<std::uint32_t> tested;
  for (const Statement &statement : tree.statementsOf(loop.doBlock))
    if (const auto *head = std::get_if<While>(&statement.node); head && head->condition)
      for (const ExpressionId id : subexpressions(tree, *head->condition))
        if (const auto number = variableNumber(tree, id))
          tested.push_back(*number);
  return tested;
}

void checkPair(const Loop &outer, const Loop &inner, const FileContext &context, const Reporter &reporter,
               std::set<Span> &reported) {
  const SyntaxTree &tree = context.tree;
  const std::vector<std::uint32_t> inInner = testedBy(inner, tree);
  for (const std::uint32_t variable : testedBy(outer, tree)) {
    if (inInner.empty() || std::ranges::find(inInner, variable) != inInner.end())
      continue; // the inner loop stops in time
    const auto own = stepOutsideOf(inner, variable, outer, tree);
    const auto other = firstStep(variable, inner.doBlock, inner.endBlock->next(), tree);
    if (!own || !other || !reported.insert(other->statement).second)
      continue;
    reporter.report({.message = fmt::format("the inner loop also changes {}, the counter of the outer loop",
                                            context.quoted(other->target)),
                     .span = other->statement,
                     .labels = {{tree.statements[outer.doStatement].span, "the outer loop"},
                                {own->statement, "the step of the outer loop"},
                                {tree.statements[inner.doStatement].span, "the inner loop"}},
                     .notes = {"the outer loop skips iterations; give the inner loop its own counter"}});
  }
}

void check(const FileContext &context, const Reporter &reporter) {
  std::set<Span> reported;
  for (const Loop &outer : context.model.loops)
    for (const Loop &inner : context.model.loops)
      if (outer.endBlock && inner.endBlock && outer.doBlock < inner.doBlock && *inner.endBlock < *outer.endBlock)
        checkPair(outer, inner, context, reporter, reported);
}

} // namespace

extern const Rule sharedLoopCounter;
const Rule sharedLoopCounter{.info = {.name = "shared-loop-counter",
                                      .category = Category::Flow,
                                      .severity = Severity::Warning,
                                      .summary = "Reports an inner loop that changes the counter of the outer loop.",
                                      .formerName = "loop-counter-clobbered"},
                             .hooks = {.file = check}};

} // namespace feedhold::rules::shared_loop_counter
