// loop-without-advance: every pass of a loop makes the same moves, since G91 may not be in force.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::loop_without_advance {
namespace {

class LoopWithoutAdvance final : public FlowRule {
public:
  LoopWithoutAdvance(ProgramId program, const FileContext &context) : view_(program, context) {
    for (const Loop &loop : context.model.loopsOf(program))
      if (loop.endBlock)
        lastEnd_ = std::max(lastEnd_, *loop.endBlock);
  }

  void after(NodeId node, const AbstractState &state) override {
    if (view_.node(node).block > lastEnd_ || isHavocked(state) || !view_.inForce(state, ModalKind::Distance) ||
        view_.surely(state, ModalKind::Distance, {CodeAction::Incremental}) || view_.modalMotionWords(node).empty())
      return;
    mayBeAbsolute_.insert(node);
    if (view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}))
      absolute_.insert(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const Loop &loop : context.model.loopsOf(view_.program()))
      if (loop.endBlock && loop.doBlock < *loop.endBlock)
        check(loop, facts, context, reporter);
  }

private:
  void check(const Loop &loop, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) const {
    const auto move = onlyMove(loop, facts, context);
    if (!move || !mayBeAbsolute_.contains(*move))
      return;
    const auto words = view_.modalMotionWords(*move);
    const auto depth =
        std::ranges::find_if(words, [](const Word *word) { return word->form() == WordForm::Expression; });
    if (depth == words.end() ||
        std::ranges::any_of(words, [&](const Word *word) { return changes(*word, loop, context); }))
      return;
    reporter.report(
        {.message = fmt::format("every iteration of this loop moves to the same {}", context.quoted((*depth)->span())),
         .span = (*depth)->span(),
         .labels = {{context.tree.statements[loop.doStatement].span, "the loop"}},
         .flow = pathFromEntry(facts, *move),
         .notes = {absolute_.contains(*move)
                       ? "G90 is active: from the second iteration on, the axis does not move"
                       : "unless the caller has set G91, the axis does not move from the second iteration on",
                   "write G91 before the loop, or compute the coordinate from the counter"}});
  }

  /// The one node of the loop that moves: a loop with several goes out and back, and may well repeat that.
  std::optional<NodeId> onlyMove(const Loop &loop, const FlowFacts &facts, const FileContext &context) const {
    if (!context.model.callsIn(loop.doBlock, loop.endBlock->next()).empty())
      return std::nullopt;
    std::optional<NodeId> only;
    for (NodeId node = view_.cfg().nodeOf(loop.doBlock); node < facts.end() && view_.node(node).block <= *loop.endBlock;
         node = node.next()) {
      if (!facts.isReached(node) || view_.wordsOf(node).empty())
        continue;
      if (only || view_.modalMotionWords(node).empty())
        return std::nullopt;
      only = node;
    }
    return only;
  }

  /// Something that the word reads is written in the loop, or changes by itself.
  static bool changes(const Word &word, const Loop &loop, const FileContext &context) {
    if (word.form() != WordForm::Expression)
      return false;
    for (const ExpressionId id : subexpressions(context.tree, word.expression())) {
      const auto &node = context.tree.expressions[id].node;
      if (std::holds_alternative<IndirectVariable>(node) || std::holds_alternative<NamedVariable>(node))
        return true;
      const auto number = variableNumber(context.tree, id);
      if (!number)
        continue;
      const VariableRange *range = findVariable(context.dialect, *number);
      if (!range || range->kind == VariableKind::System)
        return true;
      for (const VariableUse &use : context.model.variablesIn(loop.doBlock, loop.endBlock->next()))
        if (use.write && (!use.number || use.number == number))
          return true;
    }
    return false;
  }

  MotionView view_;
  BlockId lastEnd_{0}; // of the loops: what a program without any does is not kept
  std::set<NodeId> mayBeAbsolute_;
  std::set<NodeId> absolute_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<LoopWithoutAdvance>(program, context);
}

} // namespace

extern const Rule loopWithoutAdvance;
const Rule loopWithoutAdvance{.info = {"loop-without-advance", Category::Motion, Severity::Warning,
                                       "Reports a loop whose only move goes to the same computed position in every "
                                       "iteration, unless `G91` is active."},
                              .hooks = {.watch = watch}};

} // namespace feedhold::rules::loop_without_advance
