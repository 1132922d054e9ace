// counter-stays-at-limit: `WHILE[#1LE#2]DO1` with `IF[#1GT#2]THEN#1=#2` as the last that happens to #1 in the loop.
#include "rules/flow/definitions.h"
#include "rules/flow/loop_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::counter_stays_at_limit {
namespace {

/// `#1LE#2`: the counter and the limit, and whether the counter rises to it.
struct Bound {
  ExpressionId counter;
  ExpressionId limit;
  bool rises;
};

/// `isOrEqual`: LE and GE, else LT and GT; `isNegated`: what holds where the condition does not.
std::vector<Bound> boundsIn(const FileContext &context, ExpressionId condition, bool isOrEqual, bool isNegated) {
  const auto *relation = asInside<BinaryOperation>(context.tree, condition);
  if (!relation)
    return {};
  const auto is = [&](OperatorKind op, OperatorKind negated) { return relation->op == (isNegated ? negated : op); };
  const bool isLess = isOrEqual ? is(OperatorKind::LessOrEqual, OperatorKind::GreaterThan)
                                : is(OperatorKind::LessThan, OperatorKind::GreaterOrEqual);
  const bool isMore = isOrEqual ? is(OperatorKind::GreaterOrEqual, OperatorKind::LessThan)
                                : is(OperatorKind::GreaterThan, OperatorKind::LessOrEqual);
  if (!isLess && !isMore)
    return {};
  return {{relation->left, relation->right, isLess}, {relation->right, relation->left, isMore}};
}

/// The variables of the limit stay as they are in the loop.
bool isFixed(const FlowFacts &facts, const LoopFlow &loop, ExpressionId limit, NodeId at) {
  const auto reads = readsIn(facts.file, limit, facts.node(at).block);
  return std::ranges::all_of(reads, [&](const Read &read) {
    const auto number = variableOf(facts, read.expression);
    const auto writes = number && isPlain(facts.file, *number) ? writesTo(facts, loop, *number) : std::nullopt;
    return writes && writes->empty();
  });
}

class CutOff {
public:
  CutOff(const FlowFacts &facts, const FileContext &context, const LoopFlow &loop, const LoopExit &exit)
      : facts_(facts), context_(context), loop_(loop), exit_(exit) {}

  /// The assignment that sets the counter back to its limit, of a loop that goes on there.
  std::optional<LoopWrite> find() const {
    for (const Bound &bound : boundsIn(context_, exit_.condition, true, exit_.leavesWhenTrue)) {
      const auto counter = variableOf(facts_, bound.counter);
      const auto writes = counter && isPlain(facts_.file, *counter) ? writesTo(facts_, loop_, *counter) : std::nullopt;
      if (!writes || writes->size() < 2 || !isFixed(facts_, loop_, bound.limit, exit_.test))
        continue;
      const LoopWrite last = *std::ranges::max_element(*writes, {}, &LoopWrite::node);
      if (setsBack(last, bound) && isMade(last, bound))
        return last;
    }
    return std::nullopt;
  }

private:
  Span spanOf(ExpressionId id) const { return context_.tree.expressions[unwrapped(context_.tree, id)].span; }
  bool isSame(ExpressionId a, ExpressionId b) const { return sameText(context_, spanOf(a), spanOf(b)); }
  bool setsBack(const LoopWrite &write, const Bound &bound) const {
    return isSame(write.assignment.value, bound.limit);
  }
  /// In every pass that comes beyond the limit: the test stands in the loop itself, not in a branch of it.
  bool isMade(const LoopWrite &write, const Bound &bound) const {
    const auto from = onlyPredecessor(facts_, write.node);
    const auto *test = from ? std::get_if<Test>(&facts_.node(*from).instruction) : nullptr;
    if (!test || !test->condition)
      return false;
    const bool whenTrue = test->taken == write.node;
    const auto bounds = boundsIn(context_, *test->condition, false, !whenTrue);
    return std::ranges::any_of(bounds,
                               [&](const Bound &beyond) {
                                 return isSame(beyond.counter, bound.counter) && isSame(beyond.limit, bound.limit) &&
                                        beyond.rises != bound.rises;
                               }) &&
           isPassedAlways(facts_, *from, lastOfLoop());
  }
  NodeId lastOfLoop() const { return *std::ranges::max_element(loop_.nodes); }

  const FlowFacts &facts_;
  const FileContext &context_;
  const LoopFlow &loop_;
  const LoopExit &exit_;
};

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  for (const LoopFlow &loop : loopsOf(facts)) {
    if (loop.exits.size() != 1 || !loop.exitsAreKnown || (loop.changesUnseen && !loop.keepsLocals))
      continue;
    const LoopExit &exit = loop.exits.front();
    const auto write = CutOff(facts, context, loop, exit).find();
    if (!write)
      continue;
    const Span condition = context.tree.expressions[exit.condition].span;
    const Span counter = context.tree.expressions[write->assignment.target].span;
    reporter.report({.message = fmt::format("{}: {} goes on at the limit, to which {} is set back", endlessnessOf(loop),
                                            context.quoted(condition), context.quoted(counter)),
                     .span = condition,
                     .labels = {{context.tree.blocks[facts.node(write->node).block].span(), "never beyond the limit"}},
                     .notes = {"leave the loop behind the pass at the limit, or compare without `=` and make the last "
                               "pass behind the loop"}});
  }
}

} // namespace

extern const Rule counterStaysAtLimit;
const Rule counterStaysAtLimit{.info = {"counter-stays-at-limit", Category::Flow, Severity::Error,
                                        "Reports a loop that goes on at the limit to which its counter is set back."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::counter_stays_at_limit
