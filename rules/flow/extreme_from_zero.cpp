// extreme-from-zero: `#13=0`, and in a loop `IF[#5063GT#13]THEN#13=#5063`.
#include "rules/flow/definitions.h"
#include "rules/flow/loop_view.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::extreme_from_zero {
namespace {

struct Search {
  std::uint32_t extreme; // the variable that keeps the largest or the smallest
  std::uint32_t position;
  bool positionIsGreater; // where the condition is true
};

struct Start {
  Span zero;
  bool takesWhenTrue; // the position, where the condition is true
};

/// `#5063GT#13`, `#13LT#5063`
std::optional<Search> searchIn(const FlowFacts &facts, const FileContext &context, const BinaryOperation &relation) {
  const auto left = variableOf(facts, unwrapped(context.tree, relation.left));
  const auto right = variableOf(facts, unwrapped(context.tree, relation.right));
  const bool isGreater = relation.op == OperatorKind::GreaterThan || relation.op == OperatorKind::GreaterOrEqual;
  const bool isLess = relation.op == OperatorKind::LessThan || relation.op == OperatorKind::LessOrEqual;
  if (!left || !right || (!isGreater && !isLess))
    return std::nullopt;
  const auto isSkip = [&](std::uint32_t variable) { return roleOf(context, variable) == VariableRole::SkipPosition; };
  if (isSkip(*left) && isPlain(facts.file, *right))
    return Search{*right, *left, isGreater};
  return isSkip(*right) && isPlain(facts.file, *left) ? std::optional(Search{*left, *right, isLess}) : std::nullopt;
}

/// The outcome of the test that leads to the node.
std::optional<bool> outcomeTo(const FlowFacts &facts, NodeId test, NodeId node) {
  for (const PassedTest &passed : testsBefore(facts, node))
    if (passed.node == test)
      return passed.isTrue;
  return std::nullopt;
}

/// Of the variable before the search: the literal 0, and beside it only the position itself.
std::optional<Start> startOf(const FlowFacts &facts, const FileContext &context, NodeId test, const Search &search) {
  const auto known = definitionsOf(facts, search.extreme, test);
  if (!known || known->fromEntry)
    return std::nullopt;
  std::optional<Span> zero;
  std::optional<bool> takesWhenTrue;
  for (const NodeId node : known->nodes) {
    const auto assignment = assignmentTo(facts, node, search.extreme);
    const auto literal = assignment ? literalValue(context.tree, assignment->value) : std::nullopt;
    if (literal && literal->isZero() && !zero)
      zero = context.tree.blocks[facts.node(node).block].span();
    else if (assignment && variableOf(facts, unwrapped(context.tree, assignment->value)) == search.position)
      takesWhenTrue = outcomeTo(facts, test, node);
    else
      return std::nullopt;
  }
  return zero && takesWhenTrue ? std::optional(Start{*zero, *takesWhenTrue}) : std::nullopt;
}

/// Z of what is touched from above is mostly below the zero point; X and Y may well be positive all along.
bool isMostlyNegative(const FileContext &context, std::uint32_t position) {
  const VariableRange *range = findVariable(context.dialect, position);
  return range && position - range->first == static_cast<std::uint32_t>(indexOf(Axis::Z));
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const auto *relation = test && test->condition && facts.isReached(node)
                               ? asInside<BinaryOperation>(context.tree, *test->condition)
                               : nullptr;
    const auto search = relation ? searchIn(facts, context, *relation) : std::nullopt;
    const auto start = search ? startOf(facts, context, node, *search) : std::nullopt;
    if (!start)
      continue;
    const bool isLargest = search->positionIsGreater == start->takesWhenTrue;
    const std::string_view which = isLargest ? "largest" : "smallest";
    const std::string_view sign = isLargest ? "negative" : "positive";
    reporter.report({.message = fmt::format("the search for the {} `#{}` begins at 0", which, search->position),
                     .span = context.tree.expressions[*test->condition].span,
                     .labels = {{start->zero, "begins here"}},
                     .notes = {fmt::format("where all positions are {}, none is taken, and the result is 0", sign),
                               fmt::format("begin with the first position, or with `{}99999.`", isLargest ? "-" : "")}},
                    isLargest && isMostlyNegative(context, search->position) ? Severity::Warning : Severity::Info);
  }
}

} // namespace

extern const Rule extremeFromZero;
const Rule extremeFromZero{.info = {"extreme-from-zero", Category::Flow, Severity::Warning,
                                    "Reports a search for the largest or smallest skip position that begins at 0."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules::extreme_from_zero
