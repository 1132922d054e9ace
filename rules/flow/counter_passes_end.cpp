// counter-passes-end: `IF[#1EQ10]GOTO20` ends the loop, and `#1=#1+3` goes from 9 to 12.
#include "rules/flow/loop_count.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::rules::counter_passes_end {
namespace {

/// The sides that are compared, in the last pass before they cross and in the next one.
struct Passing {
  double before;
  double behind;
  double limit;
};

constexpr double kNear = 0.001; // closer than this is a question of rounding
constexpr int kMostPasses = 2000;

/// The counter crosses its limit and is not equal to it.  It goes on in the same direction: its step stays.
std::optional<Passing> passingOf(const Formulas &formulas, const LoopEnd &end, FormulaSetting setting) {
  const FormulaInput::Counter &counter = *formulas.input(end.counter).counter;
  std::optional<RoundedNumber> &count = setting[end.counter.index()];
  count = formulas.value(counter.start, setting);
  std::optional<double> last;
  for (int i = 0; count && i <= kMostPasses; ++i) {
    const auto left = formulas.value(end.left, setting);
    const auto right = formulas.value(end.right, setting);
    if (!left || !right)
      return std::nullopt;
    const double counted = (end.countsOnLeft ? left : right)->exact.toDouble();
    const double limit = (end.countsOnLeft ? right : left)->exact.toDouble();
    const double distance = counted - limit;
    const bool isTested = i > 0 || !end.testsAfterStep;
    if (isTested && std::abs(distance) < kNear)
      return std::nullopt;
    if (last && (*last - limit) * distance < 0)
      return Passing{*last, counted, limit};
    last = counted;
    count = formulas.stepped(counter, *count, setting);
  }
  return std::nullopt;
}

/// The limit is the same in each pass.
bool isLimitFixed(const Formulas &formulas, const LoopEnd &end) {
  const auto inputs = formulas.inputsOf(end.countsOnLeft ? end.right : end.left);
  return std::ranges::find(inputs, end.counter) == inputs.end();
}

void report(const Formulas &formulas, const LoopFlow &loop, const LoopExit &exit, const LoopEnd &end,
            const Passing &passing, const FormulaSetting &setting, const FileContext &context,
            const Reporter &reporter) {
  const FormulaInput &counted = formulas.input(end.counter);
  const std::string given = describeSetting(formulas, end.inputs, setting);
  const ExpressionId side = end.countsOnLeft ? end.relation->left : end.relation->right;
  Diagnostic diagnostic{
      .message = fmt::format("{}{}: {} goes from {} to {} and is never {}", given.empty() ? "" : given + ", ",
                             endlessnessOf(loop), context.quoted(context.tree.expressions[side].span), passing.before,
                             passing.behind, passing.limit),
      .span = context.tree.expressions[exit.condition].span,
      .notes = {"only equality ends the loop, and the step passes over it",
                "compare with GT, GE, LT or LE, and set the counter to the limit when a step would pass it"}};
  const auto assignment = assignmentTo(formulas.facts(), counted.counter->step, counted.variable);
  if (const auto step = assignment ? stepOf(formulas.facts(), *assignment, counted.variable) : std::nullopt)
    diagnostic.labels = {{context.tree.expressions[step->size].span, "the step"}};
  reporter.report(std::move(diagnostic), given.empty() ? Severity::Warning : Severity::Info);
}

void checkLoop(const FlowFacts &facts, const LoopFlow &loop, const LoopExit &exit, const FileContext &context,
               const Reporter &reporter) {
  Formulas formulas(facts);
  const auto end = endOf(formulas, loop, exit);
  if (!end || !isEquality(*end) || !isLimitFixed(formulas, *end))
    return;
  const bool isKnown = std::ranges::all_of(end->inputs, [&](FormulaInputId id) { return id == end->counter; });
  if (!isKnown && formulas.inputsOf(formulas.input(end->counter).counter->size).empty())
    return; // a literal step: whole numbers are counted
  const auto guards = formulas.guardsOf(loop.head);
  int budget = 200;
  std::optional<Passing> passing;
  const auto setting = findSetting(formulas, end->inputs, [&](FormulaSetting &tried) {
    if (--budget < 0 || !formulas.pass(guards, tried))
      return false;
    passing = passingOf(formulas, *end, tried);
    return passing.has_value();
  });
  if (setting)
    report(formulas, loop, exit, *end, *passing, *setting, context, reporter);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::vector<NodeId> done;
  for (const LoopFlow &loop : loopsOf(facts)) {
    const LoopExit *only = onlyExit(loop);
    if (!only)
      continue;
    const LoopExit &exit = *only;
    if (std::ranges::find(done, exit.test) != done.end())
      continue;
    done.push_back(exit.test);
    checkLoop(facts, loop, exit, context, reporter);
  }
}

} // namespace

extern const Rule counterPassesEnd;
const Rule counterPassesEnd{.info = {"counter-passes-end", Category::Flow, Severity::Warning,
                                     "Reports a loop that only equality ends, and whose counter steps over that "
                                     "value."},
                            .hooks = {.flow = check}};

} // namespace feedhold::rules::counter_passes_end
