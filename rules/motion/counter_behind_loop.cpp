// counter-behind-loop: `WHILE[#1LE#2]DO1`, `G01 Z-#1`, `#1=#1+2`, `END1`, and then `G01 Z-#1`.
#include "rules/flow/loop_count.h"
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::counter_behind_loop {
namespace {

class Loop {
public:
  Loop(const FlowFacts &facts, const FileContext &context, const LoopFlow &flow, const LoopEnd &end,
       const FormulaInput &counter)
      : facts_(facts), context_(context), view_(facts.program, context), flow_(flow), end_(end), counter_(counter) {}

  /// The loop goes on while the counter meets its limit, so that it ends beyond it.
  bool endsBeyond() const {
    const OperatorKind op = end_.relation->op;
    const bool goesOnAtLimit = op == OperatorKind::LessOrEqual || op == OperatorKind::GreaterOrEqual;
    return goesOnAtLimit != end_.leavesWhenTrue;
  }
  /// Behind the loop, before the counter is set again.
  const Word *cutBehind() const {
    for (auto node = exit(); node; node = next(*node)) {
      if (changesCounter(*node) || calls(*node))
        return nullptr;
      if (!cuts(*node))
        continue;
      for (const Word *word : view_.modalMotionWords(*node))
        if (isOfCounter(*word))
          return isRepeated(*word) ? word : nullptr;
    }
    return nullptr;
  }

private:
  static constexpr std::initializer_list<CodeAction> kCuts = {CodeAction::Linear, CodeAction::ArcClockwise,
                                                              CodeAction::ArcCounterclockwise};
  std::optional<NodeId> exit() const {
    std::optional<NodeId> found;
    forEachSuccessor(facts_.file.cfg, *facts_.file.model, flow_.exits.front().test, ProgramUse::Called,
                     [&](NodeId next) {
                       if (!std::ranges::binary_search(flow_.nodes, next))
                         found = next;
                     });
    return found;
  }
  /// Absent where other paths join, or several go on.
  std::optional<NodeId> next(NodeId node) const {
    std::optional<NodeId> found;
    std::size_t count = 0;
    forEachSuccessor(facts_.file.cfg, *facts_.file.model, node, ProgramUse::Called, [&](NodeId next) {
      found = next;
      ++count;
    });
    return count == 1 && found > node && onlyPredecessor(facts_, *found) == node ? found : std::nullopt;
  }
  bool changesCounter(NodeId node) const {
    return std::ranges::any_of(assignmentsOf(facts_, node), [&](const Assignment &assignment) {
      return variableOf(facts_, assignment.target).value_or(counter_.variable) == counter_.variable;
    });
  }
  bool calls(NodeId node) const {
    const BlockId block = view_.node(node).block;
    return !context_.model.callsIn(block, block.next()).empty();
  }
  /// By the last code of motion in the text.
  bool cuts(NodeId node) const {
    for (NodeId at = node;; at = NodeId(at.index() - 1)) {
      if (view_.findAction(at, kCuts))
        return true;
      if (view_.findAction(at, {CodeAction::Rapid}) || at == facts_.entry())
        return false;
    }
  }
  /// A sum with the counter and no function: an angle may go round once more.
  bool isOfCounter(const Word &word) const {
    if (word.form() != WordForm::Expression)
      return false;
    const auto terms = termsOf(context_.tree, word.expression());
    return std::ranges::any_of(
        terms, [&](const SumTerm &term) { return variableOf(facts_, term.value) == counter_.variable; });
  }
  /// The loop cuts at the same words, before the counter makes its step.
  bool isRepeated(const Word &word) const {
    return std::ranges::any_of(flow_.nodes, [&](NodeId node) {
      const auto words = view_.modalMotionWords(node);
      return cuts(node) &&
             std::ranges::any_of(words,
                                 [&](const Word *other) {
                                   return other->address() == word.address() &&
                                          sameText(context_, other->span(), word.span());
                                 }) &&
             isBeforeStep(node);
    });
  }
  bool isBeforeStep(NodeId node) const {
    const NodeId step = counter_.counter->step;
    return !findPath(facts_, step, node, [&](NodeId at) { return at == flow_.head; }) &&
           passesAlways(facts_, flow_, node);
  }

  const FlowFacts &facts_;
  const FileContext &context_;
  MotionView view_;
  const LoopFlow &flow_;
  const LoopEnd &end_;
  const FormulaInput &counter_;
};

void checkLoop(const FlowFacts &facts, const LoopFlow &flow, const FileContext &context, const Reporter &reporter) {
  Formulas formulas(facts);
  const auto end = endOf(formulas, flow, flow.exits.front());
  if (!end || isEquality(*end))
    return;
  const FormulaInput counter = formulas.input(end->counter);
  const ExpressionId counted = end->countsOnLeft ? end->relation->left : end->relation->right;
  const ExpressionId limit = end->countsOnLeft ? end->relation->right : end->relation->left;
  const Loop loop(facts, context, flow, *end, counter);
  if (variableOf(facts, counted) != counter.variable || !loop.endsBeyond())
    return;
  const Word *word = loop.cutBehind();
  if (!word)
    return;
  const std::string variable = facts.programs.nameOfVariable(counter.variable);
  reporter.report({.message = fmt::format("`{}` is beyond {} here: the loop has counted one step more than it cut",
                                          variable, context.quoted(context.tree.expressions[limit].span)),
                   .span = word->span(),
                   .labels = {{context.tree.expressions[flow.exits.front().condition].span, "ends the loop"},
                              {context.tree.blocks[facts.node(counter.counter->step).block].span(), "the step"}},
                   .notes = {"the tool goes one step farther than in the last pass of the loop",
                             "write the limit here, or take the step back"}});
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  for (const LoopFlow &loop : loopsOf(facts))
    if (loop.exitsAreKnown && loop.exits.size() == 1 && !loop.changesUnseen)
      checkLoop(facts, loop, context, reporter);
}

} // namespace

extern const Rule counterBehindLoop;
const Rule counterBehindLoop{
    .info = {"counter-behind-loop", Category::Motion, Severity::Warning,
             "Reports a cut behind a loop at the value of its counter, which has gone beyond the limit."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::counter_behind_loop
