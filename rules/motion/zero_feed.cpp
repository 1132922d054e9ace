// zero-feed: `G01 X20. F0`.
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::zero_feed {
namespace {

bool isZeroFeed(const Word &word) {
  return word.address() == 'F' && word.isNumber() && word.number().isZero() && !word.has(Word::kArgument);
}

class ZeroFeed final : public FlowRule {
public:
  ZeroFeed(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    const AbstractValue &feed = state.word('F');
    if (isHavocked(state) || feed.mayBeVacant() || !feed.isNumber() || feed.number().interval().lo != 0 ||
        feed.number().interval().hi != 0 || view_.modalMotionWords(node).empty() || !cuts(state))
      return;
    first_.note(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    const Word *feed = first_.node() ? lastFeed(facts) : nullptr;
    if (!feed)
      return;
    const bool stops = context.dialect.behaviour.stopsAtStrayWords;
    const Word &word = *view_.modalMotionWords(*first_.node()).front();
    Diagnostic diagnostic{.message = fmt::format("the cutting move to {} has the feed 0", context.quoted(word.span())),
                          .span = word.span(),
                          .labels = {{feed->span(), "the feed"}},
                          .notes = {fmt::format("the control {}{}", stopsWith(context.dialect, AlarmKind::ZeroFeed),
                                                stops ? "" : ", or waits without a move"),
                                    "write the feed that is meant"}};
    reporter.report(std::move(diagnostic), stops ? Severity::Error : Severity::Warning);
  }

private:
  /// A number in the text before the move; null where a variable gives the feed, as in a template.
  const Word *lastFeed(const FlowFacts &facts) const {
    const Word *last = nullptr;
    for (NodeId node = facts.entry(); node <= *first_.node(); node = node.next())
      for (const Word *word : view_.wordsOf(node))
        if (word->address() == 'F')
          last = word;
    return last && isZeroFeed(*last) ? last : nullptr;
  }
  bool cuts(const AbstractState &state) const {
    return view_.surely(
               state, ModalKind::Motion,
               {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise, CodeAction::Thread}) ||
           view_.surely(state, ModalKind::Cycle,
                        {CodeAction::CycleDrill, CodeAction::CycleDwell, CodeAction::CyclePeck,
                         CodeAction::CycleChipBreak, CodeAction::CycleTap, CodeAction::CycleTapLeft,
                         CodeAction::CycleBore, CodeAction::CycleBoreStop});
  }

  MotionView view_;
  FirstSeen first_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ZeroFeed>(program, context);
}

} // namespace

extern const Rule zeroFeed;
const Rule zeroFeed{
    .info = {"zero-feed", Category::Motion, Severity::Warning, "Reports a cutting move with the feed 0."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::zero_feed
