// inverse-time-without-feed: `G93 G01 X10. F5.`, and `X20.` without an F of its own.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::inverse_time_without_feed {
namespace {

class InverseTimeWithoutFeed final : public FlowRule {
public:
  InverseTimeWithoutFeed(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (view_.mayHave(node, 'F') || !view_.mayBe(state, ModalKind::FeedMode, {CodeAction::FeedInverse}))
      return refuse(node);
    const auto words = view_.modalMotionWords(node);
    if (words.empty())
      return;
    const bool lacks = !isHavocked(state) && view_.surely(state, ModalKind::FeedMode, {CodeAction::FeedInverse}) &&
                       view_.surely(state, ModalKind::Motion,
                                    {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}) &&
                       !isCycle(state);
    const auto [at, isNew] = places_.emplace(node, lacks ? words.front() : nullptr);
    if (!isNew && !lacks)
      at->second = nullptr;
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, word] : places_)
      if (word) {
        reporter.report({.message = fmt::format("the move to {} has no F of its own, and `G93` is active",
                                                context.quoted(word->span())),
                         .span = word->span(),
                         .flow = pathFromEntry(facts, node),
                         .notes = {context.dialect.hasFanucParameters
                                       ? "the control stops with PS1202 (no F command at G93)"
                                       : "the control stops with an alarm: F is the time of one block",
                                   "write F in each block that cuts, or `G94` before it"}});
        return; // the others have the same cause
      }
  }

private:
  void refuse(NodeId node) {
    if (const auto at = places_.find(node); at != places_.end())
      at->second = nullptr;
  }
  bool isCycle(const AbstractState &state) const { return isCycleKnown(state); }
  /// A cycle was programmed on some path.
  bool isCycleKnown(const AbstractState &state) const {
    return view_.wasSet(state, ModalKind::Cycle,
                        {CodeAction::CycleDrill, CodeAction::CycleDwell, CodeAction::CyclePeck,
                         CodeAction::CycleChipBreak, CodeAction::CycleTap, CodeAction::CycleTapLeft,
                         CodeAction::CycleBore, CodeAction::CycleBoreStop});
  }

  MotionView view_;
  std::map<NodeId, const Word *> places_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<InverseTimeWithoutFeed>(program, context);
}

} // namespace

extern const Rule inverseTimeWithoutFeed;
const Rule inverseTimeWithoutFeed{.info = {"inverse-time-without-feed", Category::Motion, Severity::Error,
                                           "Reports a cutting move without an `F` of its own while `G93` is active."},
                                  .hooks = {.watch = watch}};

} // namespace feedhold::rules::inverse_time_without_feed
