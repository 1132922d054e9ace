// inexact-loop-end: a loop that rounding gives another number of iterations than it has on paper.
#include "rules/flow/loop_count.h"
#include "rules/flow/margin.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::rules::inexact_loop_end {
namespace {

/// A limit that FIX cuts to another whole number is what rounded-quotient reports.
bool isCut(const Iterations &iterations) {
  return std::abs(iterations.atEnd.computed - iterations.atEnd.exact.toDouble()) > 0.5;
}

/// The loop itself makes its counter meet the limit: the step is a literal, or a part of the way.  Where an argument
/// happens to be a part of another one, a margin would be more than most programs need, unless the loop may never end.
bool isWorthTrying(const Formulas &formulas, const LoopEnd &end) {
  const FormulaId size = formulas.input(end.counter).counter->size;
  const auto ofStep = formulas.inputsOf(size);
  if (isEquality(end) || ofStep.empty())
    return true;
  return !formulas.asInput(size) && std::ranges::all_of(end.inputs, [&](FormulaInputId id) {
    return id == end.counter || std::ranges::find(ofStep, id) != ofStep.end();
  });
}

std::string messageFor(const LoopFlow &loop, const Iterations &iterations, const std::string &given,
                       const std::string &rounding) {
  const std::string condition = given.empty() ? "" : given + ", ";
  if (!iterations.computed)
    return fmt::format("{}{}: {}", condition, endlessnessOf(loop), rounding);
  return fmt::format("{}rounding gives this loop {} iteration{}, not {}: {}", condition, *iterations.computed,
                     *iterations.computed == 1 ? "" : "s", iterations.exact, rounding);
}

void report(const Formulas &formulas, const LoopFlow &loop, const LoopExit &exit, const LoopEnd &end,
            const Iterations &iterations, const FormulaSetting &setting, const FileContext &context,
            const Reporter &reporter) {
  const FormulaInput &counted = formulas.input(end.counter);
  const auto assignment = assignmentTo(formulas.facts(), counted.counter->step, counted.variable);
  const auto step = assignment ? stepOf(formulas.facts(), *assignment, counted.variable) : std::nullopt;
  const std::string given = describeSetting(formulas, end.inputs, setting);
  Diagnostic diagnostic{
      .message = messageFor(
          loop, iterations, given,
          describeRounding(context.quoted(context.tree.expressions[iterations.rounded].span), iterations.atEnd)),
      .span = context.tree.expressions[exit.condition].span,
      .notes = {"the control computes in binary numbers, of which none is 0.1 or 1/3: a sum of such "
                "steps is a little above or below the value on paper",
                "count the iterations in whole numbers, or compare with a margin"}};
  if (step)
    diagnostic.labels = {{context.tree.expressions[step->size].span, "the step"}};
  const auto size = formulas.value(counted.counter->size, setting);
  if (size && end.countsOnLeft)
    diagnostic.fixes = marginFixes(context, *end.relation, std::abs(size->computed));
  const bool isLiteral = formulas.inputsOf(counted.counter->size).empty();
  const bool isCertain = given.empty() || (isLiteral && !iterations.computed);
  reporter.report(std::move(diagnostic), isCertain ? Severity::Warning : Severity::Info);
}

bool checkCounted(const FlowFacts &facts, const LoopFlow &loop, const LoopExit &exit, const FileContext &context,
                  const Reporter &reporter) {
  Formulas formulas(facts);
  const auto end = endOf(formulas, loop, exit);
  if (!end)
    return false;
  const bool isKnown = std::ranges::all_of(end->inputs, [&](FormulaInputId id) { return id == end->counter; });
  if (!isKnown && !isWorthTrying(formulas, *end))
    return true;
  constexpr std::int64_t kMostKnown = 20'000;
  constexpr std::int64_t kMostTried = 400;
  std::int64_t budget = 100'000;
  const auto guards = formulas.guardsOf(loop.head);
  std::optional<Iterations> iterations;
  const auto setting = findSetting(formulas, end->inputs, [&](FormulaSetting &tried) {
    if (budget <= 0 || !formulas.pass(guards, tried))
      return false;
    iterations = countIterations(formulas, *end, tried, isKnown ? kMostKnown : kMostTried);
    budget -= kMostTried / 4;
    return iterations && iterations->exact != iterations->computed && !isCut(*iterations);
  });
  if (setting)
    report(formulas, loop, exit, *end, *iterations, *setting, context, reporter);
  return true;
}

/// `#10` is compared for equality with what is not followed, and grows by a literal such as .1.
void checkUnknown(const FlowFacts &facts, const LoopFlow &loop, const LoopExit &exit, const FileContext &context,
                  const Reporter &reporter) {
  const auto *relation = asInside<BinaryOperation>(context.tree, exit.condition);
  if (!relation || relation->op != (exit.leavesWhenTrue ? OperatorKind::Equal : OperatorKind::NotEqual) ||
      context.dialect.behaviour.equalTolerance > 0)
    return;
  const auto variable = variableOf(facts, relation->left);
  const auto writes = variable ? writesTo(facts, loop, *variable) : std::nullopt;
  const auto step = writes && writes->size() == 1 ? stepOf(facts, writes->front().assignment, *variable) : std::nullopt;
  const auto literal = step ? literalValue(context.tree, step->size) : std::nullopt;
  const auto size = literal ? RoundedNumber::of(*literal) : std::nullopt;
  if (!size || !size->isInexact())
    return;
  reporter.report({.message = fmt::format(
                       "this loop may never end: it needs {} to match exactly, but the step is not exact in binary",
                       context.quoted(context.tree.expressions[relation->left].span)),
                   .span = context.tree.expressions[exit.condition].span,
                   .labels = {{context.tree.expressions[step->size].span, "each iteration adds a rounding error"}},
                   .notes = {"the sum may step past the limit without ever being equal to it",
                             "compare with GT, GE, LT or LE, or count iterations in whole numbers"},
                   .fixes = marginFixes(context, *relation, std::abs(size->computed))});
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::vector<NodeId> done;
  for (const LoopFlow &loop : loopsOf(facts)) {
    if (!loop.exitsAreKnown || loop.exits.size() != 1)
      continue;
    const LoopExit &exit = loop.exits.front();
    if (std::ranges::find(done, exit.test) != done.end())
      continue;
    done.push_back(exit.test);
    if (!checkCounted(facts, loop, exit, context, reporter))
      checkUnknown(facts, loop, exit, context, reporter);
  }
}

} // namespace

extern const Rule inexactLoopEnd;
const Rule inexactLoopEnd{
    .info = {"inexact-loop-end", Category::Flow, Severity::Warning,
             "Reports a loop that has another number of iterations than on paper, because its counter is rounded."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::inexact_loop_end
