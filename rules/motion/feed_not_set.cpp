// feed-not-set: a cutting move of a main program before any F.
#include "rules/flow/loop_view.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::feed_not_set {
namespace {

class FeedNotSet final : public FlowRule {
public:
  FeedNotSet(ProgramId program, const FileContext &context)
      : view_(program, context), isMain_(startedBy(context, program) == StartedBy::Operator) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!isMain_ || isHavocked(state) || !state.word('F').mayBeVacant() ||
        !(contourCycleIn(node) || (!view_.modalMotionWords(node).empty() && cuts(state))))
      return;
    if (isAsAtEntry(state, 'F'))
      never_.note(node);
    first_.note(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    if (!first_.node())
      return;
    const auto feeds = [&](NodeId node) { return hasFeed(node); };
    const auto path = hasFeed(*first_.node()) ? std::nullopt : findPath(facts, facts.entry(), *first_.node(), feeds);
    // A retentive variable that may be vacant is a feed all the same.
    const std::optional<NodeId> place = path ? first_.node() : never_.node();
    if (!place || (path && !reachesPastLoops(facts, facts.entry(), *place, feeds, feeds)))
      return;
    const Word *cycle = contourCycleIn(*place);
    const Word &word = cycle ? *cycle : *view_.modalMotionWords(*place).front();
    reporter.report(
        {.message = fmt::format("the {} {} comes before any `F`{}", cycle ? "cut by" : "cutting move to",
                                context.quoted(word.span()), cycle || never_.node() == place ? "" : " on some path"),
         .span = word.span(),
         .flow = path ? describePath(facts, *path) : std::vector<Label>{},
         .notes = {"it uses the feed of the previous program, or the control stops because there is none",
                   "write F in the block of the first cutting move"}});
  }

private:
  bool hasFeed(NodeId node) const {
    return std::ranges::any_of(view_.wordsOf(node), [](const Word *word) { return word->address() == 'F'; });
  }
  /// The block of G71 to G73 that names the contour: the words F of the contour are passed over.
  const Word *contourCycleIn(NodeId node) const {
    const auto words = view_.wordsOf(node);
    const bool namesContour = std::ranges::any_of(words, [](const Word *word) { return word->address() == 'P'; }) &&
                              std::ranges::any_of(words, [](const Word *word) { return word->address() == 'Q'; });
    return namesContour
               ? view_.findAction(node, {CodeAction::TurnContour, CodeAction::FaceContour, CodeAction::RepeatContour})
               : nullptr;
  }
  bool cuts(const AbstractState &state) const {
    return view_.surely(state, ModalKind::Motion,
                        {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}) ||
           view_.surely(state, ModalKind::Cycle,
                        {CodeAction::CycleDrill, CodeAction::CycleDwell, CodeAction::CyclePeck,
                         CodeAction::CycleChipBreak, CodeAction::CycleTap, CodeAction::CycleTapLeft,
                         CodeAction::CycleBore, CodeAction::CycleBoreStop});
  }

  MotionView view_;
  bool isMain_;
  FirstSeen first_;
  FirstSeen never_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<FeedNotSet>(program, context);
}

} // namespace

extern const Rule feedNotSet;
const Rule feedNotSet{
    .info = {"feed-not-set", Category::Motion, Severity::Warning,
             "Reports the first cutting move of a main program when no `F` comes before it on some path."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::feed_not_set
