// unguarded-step: `#1=#1-#17` counts a loop, and nothing asks whether Q was passed.
#include "rules/flow/loop_view.h"
#include "rules/flow/passed_values.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::unguarded_step {
namespace {

struct Unguarded {
  std::uint32_t argument;
  Span step;
};

bool isNamed(std::uint32_t variable) { return variable >= kFirstNamedVariable; }

/// `#<step>=#6`, its only assignment, of a parameter that keeps its value.
std::optional<std::uint32_t> parameterBehindName(const FlowFacts &facts, std::uint32_t name) {
  std::optional<std::uint32_t> source;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    for (const Assignment &assignment : assignmentsOf(facts, node)) {
      if (variableOf(facts, assignment.target) != name)
        continue;
      const auto value = variableOf(facts, assignment.value);
      if (source || !value || isNamed(*value) || !isParameter(facts, *value) || maySet(facts, *value))
        return std::nullopt;
      source = value;
    }
  return source;
}

bool isTestedByName(const FlowFacts &facts, std::uint32_t name) {
  return std::ranges::any_of(readsOf(facts), [&](const Read &read) {
    return variableOf(facts, read.expression) == name &&
           (read.use == ReadUse::Equality || read.use == ReadUse::Ordering);
  });
}

/// The argument that is the step, when it may be nothing and no condition asks for it.
std::optional<std::uint32_t> openArgument(const FlowFacts &facts, std::uint32_t name, const AbstractValue &size) {
  if (!size.mayBeVacant() && !size.number().contains(0))
    return std::nullopt;
  const auto argument = isNamed(name)               ? parameterBehindName(facts, name)
                        : isLocal(facts.file, name) ? argumentBehind(facts, name)
                                                    : std::nullopt;
  const bool isAsked = isNamed(name) ? isTestedByName(facts, name) : isTested(facts.file, facts.program, name);
  return argument && !isAsked && !isTested(facts.file, facts.program, *argument) &&
                 !mayHoldCallersValue(facts, *argument)
             ? argument
             : std::nullopt;
}

/// The only step of the variable in the loop is an argument that nothing tests.
std::optional<Unguarded> unguardedStep(std::uint32_t variable, const LoopFlow &loop, const FlowFacts &facts) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto writes = writesTo(facts, loop, variable);
  if (!writes || writes->size() != 1)
    return std::nullopt;
  const auto step = stepOf(facts, writes->front().assignment, variable);
  const auto name = step ? variableOf(facts, step->size) : std::nullopt;
  const AbstractValue *size = name ? facts.valueOf(step->size) : nullptr;
  const auto argument = size ? openArgument(facts, *name, *size) : std::nullopt;
  if (!argument)
    return std::nullopt;
  return Unguarded{*argument, cover(tree.expressions[writes->front().assignment.target].span,
                                    tree.expressions[writes->front().assignment.value].span)};
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isMainProgram(facts))
    return;
  std::vector<std::uint32_t> done;
  for (const LoopFlow &loop : loopsOf(facts)) {
    const LoopExit *only = onlyExit(loop);
    if (!only)
      continue;
    const LoopExit &exit = *only;
    for (const Read &read : readsIn(facts.file, exit.condition, facts.node(exit.test).block)) {
      const auto counter = variableOf(facts, read.expression);
      const auto found = counter ? unguardedStep(*counter, loop, facts) : std::nullopt;
      if (!found || std::ranges::find(done, found->argument) != done.end())
        continue;
      done.push_back(found->argument);
      const PassedValues passed = passedFor(found->argument, facts, context);
      if (passed.zero == PassedZero::Never)
        continue;
      Diagnostic diagnostic{
          .message = fmt::format("{} is the step of a loop and may be 0{}: nothing checks it",
                                 describeVariable(context.dialect, found->argument),
                                 context.dialect.behaviour.variablesMayBeVacant ? " or vacant" : ""),
          .span = found->step,
          .labels = {{context.tree.expressions[exit.condition].span, "the condition that ends the loop"}},
          .flow = pathFromEntry(facts, exit.test),
          .notes = {"if it is not passed, or is 0, the loop never ends",
                    adviceToCheck(context.dialect, found->argument)}};
      addPassed(diagnostic, passed, facts);
      reporter.report(std::move(diagnostic));
    }
  }
}

} // namespace

extern const Rule unguardedStep;
const Rule unguardedStep{.info = {"unguarded-step", Category::Flow, Severity::Warning,
                                  "Reports a loop whose step is an argument that is never checked for 0."},
                         .hooks = {.flow = check}};

} // namespace feedhold::rules::unguarded_step
