// stale-common-variable: `Z#510`, and the program sets `#510` only later.
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::stale_common_variable {
namespace {

std::optional<VariableKind> commonKind(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  const bool isCommon = range && (range->kind == VariableKind::Common || range->kind == VariableKind::Retentive);
  return isCommon ? std::optional(range->kind) : std::nullopt;
}

/// Not what the clock or the machine says, which is kept for the next run on purpose.
bool isPlainValue(const FlowFacts &facts, ExpressionId value) {
  return std::ranges::all_of(subexpressions(*facts.file.tree, value), [&](ExpressionId part) {
    const auto number = variableNumber(*facts.file.tree, part);
    return !number || isPlain(facts.file, *number);
  });
}

/// The assignments to the variable; absent when one computes the new value from the old one: a counter.
std::optional<std::vector<NodeId>> plainWrites(const FlowFacts &facts, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  std::vector<NodeId> writes;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    for (const Assignment &assignment : assignmentsOf(facts, node)) {
      const auto target = variableNumber(tree, unwrapped(tree, assignment.target));
      if (!target && as<IndirectVariable>(tree, unwrapped(tree, assignment.target)))
        return std::nullopt;
      if (target != variable || !facts.isReached(node))
        continue;
      const auto reads = readsIn(facts.file, assignment.value, facts.node(node).block);
      if (std::ranges::any_of(reads, [&](const Read &read) { return read.number == variable; }) ||
          !isPlainValue(facts, assignment.value))
        return std::nullopt;
      writes.push_back(node);
    }
  return writes;
}

bool callsBefore(const FileContext &context, ProgramId program, BlockId block) {
  const auto calls = context.model.callsOf(program);
  return std::ranges::any_of(calls, [&](const Call &call) { return call.block < block; });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!isMainProgram(facts) || isTooLarge(facts))
    return;
  std::vector<std::uint32_t> done;
  for (const Read &read : readsOf(facts)) {
    const auto kind = read.number ? commonKind(context, *read.number) : std::nullopt;
    if (!kind || std::ranges::find(done, *read.number) != done.end())
      continue;
    done.push_back(*read.number);
    const auto node = nodeOf(facts, read.block, read.expression);
    const auto writes = node ? plainWrites(facts, *read.number) : std::nullopt;
    if (!writes || writes->empty() || isPromised(facts, context, *read.number) ||
        isTested(facts.file, facts.program, *read.number) || callsBefore(context, facts.program, read.block))
      continue;
    const auto sets = [&](NodeId each) { return std::ranges::find(*writes, each) != writes->end(); };
    const bool comesAround =
        std::ranges::any_of(*writes, [&](NodeId write) { return findPath(facts, write, *node, sets).has_value(); });
    const auto path = findPath(facts, facts.entry(), *node, sets);
    if (comesAround || !path)
      continue;
    const Span span = context.tree.expressions[read.expression].span;
    reporter.report({.message = fmt::format("{} is used here but only set later", context.quoted(span)),
                     .span = span,
                     .labels = {{context.tree.blocks[facts.node(writes->front()).block].span(), "set here"}},
                     .flow = describePath(facts, *path),
                     .notes = {"here it still has the value from the last run or from another program",
                               "set it before its first use"}},
                    *kind == VariableKind::Common ? Severity::Warning : Severity::Info);
  }
}

} // namespace

extern const Rule staleCommonVariable;
const Rule staleCommonVariable{.info = {"stale-common-variable", Category::Flow, Severity::Warning,
                                        "Reports a common variable that a main program uses before it sets it."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::stale_common_variable
