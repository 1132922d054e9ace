// skip-not-checked: `#100=#5061` behind G31, and nothing asks whether the probe has touched anything.
#include "rules/flow/flow_view.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::skip_not_checked {
namespace {

VariableRole roleOf(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  return range && range->kind == VariableKind::System ? range->role : VariableRole::Plain;
}

/// Variables that were computed from where the axes stopped.
std::set<std::uint32_t> measured(const FlowFacts &facts, const FileContext &context) {
  std::set<std::uint32_t> found;
  for (std::size_t before = 1; before != found.size();) {
    before = found.size();
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      for (const Assignment &assignment : assignmentsOf(facts, node)) {
        const auto target = variableNumber(context.tree, unwrapped(context.tree, assignment.target));
        const auto reads = readsIn(facts.file, assignment.value, facts.node(node).block);
        const bool isMeasured = std::ranges::any_of(reads, [&](const Read &read) {
          return !read.number || found.contains(*read.number) ||
                 roleOf(context, *read.number) == VariableRole::SkipPosition ||
                 roleOf(context, *read.number) == VariableRole::BlockEndPosition;
        });
        if (target && isMeasured)
          found.insert(*target);
      }
    if (before == found.size())
      break;
  }
  return found;
}

/// A condition looks at a position, at something computed from it, or at an input.
bool asksForIt(const FlowFacts &facts, const FileContext &context) {
  const auto measuredHere = measured(facts, context);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition)
      continue;
    const auto reads = readsIn(facts.file, *test->condition, facts.node(node).block);
    if (std::ranges::any_of(reads, [&](const Read &read) {
          return !read.number || measuredHere.contains(*read.number) ||
                 roleOf(context, *read.number) != VariableRole::Plain;
        }))
      return true;
  }
  return false;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const auto uses = context.model.variablesOf(facts.program);
  const auto read = std::ranges::find_if(uses, [&](const VariableUse &use) {
    return !use.write && use.number && roleOf(context, *use.number) == VariableRole::SkipPosition;
  });
  if (read == uses.end() || isTooLarge(facts) || !reachedNode(facts, read->block))
    return;
  const MotionView view(facts.program, context);
  std::optional<NodeId> skip;
  for (NodeId node = facts.entry(); node < facts.end() && !skip; node = node.next())
    for (const Word *word : view.wordsOf(node))
      if (const Code *code = word->address() == 'G' ? codeOf(*word, context.dialect) : nullptr;
          code && code->role == CodeRole::Skip)
        skip = node;
  if (!skip || asksForIt(facts, context))
    return;
  const Span span = context.tree.expressions[read->expression].span;
  reporter.report(
      {.message = fmt::format("{} is used, but nothing checks whether the skip signal came", context.quoted(span)),
       .span = span,
       .labels = {{view.blockSpan(*skip), "without a signal this moves to its end point"}},
       .notes = {"if the probe touches nothing, the end point is taken as the surface",
                 "compare the position with the end point, and raise an alarm when they are equal"}});
}

} // namespace

extern const Rule skipNotChecked;
const Rule skipNotChecked{
    .info = {"skip-not-checked", Category::Motion, Severity::Info,
             "Reports a skip position that is used without a check whether the skip signal came."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::skip_not_checked
