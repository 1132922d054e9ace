// incremental-after-reference: `G91 G28 Z0.`, and coordinates behind it without G90.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::incremental_after_reference {
namespace {

class IncrementalAfterReference final : public FlowRule {
public:
  IncrementalAfterReference(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (view_.wasSet(state, ModalKind::Distance, {CodeAction::Incremental}) && firstLiteral(node) &&
        !view_.sets(node, ModalKind::Distance))
      moves_.push_back(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    std::ranges::sort(moves_);
    moves_.erase(std::unique(moves_.begin(), moves_.end()), moves_.end());
    for (NodeId home = facts.entry(); home < facts.end(); home = home.next()) {
      if (!facts.isReached(home) || !view_.findAction(home, {CodeAction::Incremental}) ||
          !view_.findAction(home, {CodeAction::ReferenceReturn, CodeAction::SecondReference}))
        continue;
      tell(home, facts, context, reporter);
    }
  }

private:
  /// A computed word may well be a distance that was computed for this G91.
  const Word *firstLiteral(NodeId node) const {
    for (const Word *word : view_.modalMotionWords(node))
      if (word->isNumber())
        return word;
    return nullptr;
  }
  /// `X-5.7`, and in another block `X5.7`: a slide that goes and comes back by the same distance.
  bool comesBack(const Word &word) const {
    return std::ranges::any_of(moves_, [&](NodeId node) {
      return std::ranges::any_of(view_.modalMotionWords(node), [&](const Word *other) {
        return other->address() == word.address() && other->isNumber() && !word.number().isZero() &&
               other->number().toDouble() == -word.number().toDouble();
      });
    });
  }
  /// The first one only: what comes behind it is of the same kind.
  void tell(NodeId home, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
    const auto isOver = [&](NodeId node) {
      // A probing move by a distance shows that the stretch is incremental on purpose.
      return view_.sets(node, ModalKind::Distance) || view_.findAction(node, {CodeAction::Skip}) ||
             std::holds_alternative<CallProgram>(view_.node(node).instruction);
    };
    const auto move = firstReached(facts, home, moves_, isOver);
    if (!move)
      return;
    const Word &word = *firstLiteral(*move);
    if (comesBack(word))
      return;
    const auto path = findPath(facts, home, *move, isOver);
    std::erase(moves_, *move); // told once
    reporter.report(
        {.message = fmt::format("{} is incremental: the `G91` of the reference return is still active",
                                context.quoted(word.span())),
         .span = word.span(),
         .labels = {{view_.findAction(home, {CodeAction::Incremental})->span(), "active since here"}},
         .flow = describePath(facts, *path),
         .notes = {"the tool moves by this distance from where it is, not to this position",
                   "write G90 after the reference return; if incremental is meant, write G91 in this block"}});
  }

  MotionView view_;
  std::vector<NodeId> moves_; // not told yet
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<IncrementalAfterReference>(program, context);
}

} // namespace

extern const Rule incrementalAfterReference;
const Rule incrementalAfterReference{.info = {"incremental-after-reference", Category::Motion, Severity::Warning,
                                              "Reports a move under a `G91` that was written for a reference return."},
                                     .hooks = {.watch = watch}};

} // namespace feedhold::rules::incremental_after_reference
