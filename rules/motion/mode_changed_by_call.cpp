// mode-changed-by-call: a called program returns with another F, G94, G95, G20 or G21 than it was called with, with G91
// instead of G90, or without the length offset, the cutter compensation or the rotation of its caller.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <optional>

namespace feedhold::rules::mode_changed_by_call {
namespace {

constexpr std::initializer_list<CodeAction> kFeeding = {CodeAction::Linear, CodeAction::ArcClockwise,
                                                        CodeAction::ArcCounterclockwise};

/// What is in force at a place: over all states there.
struct InForce {
  CodeSet feedMode;
  CodeSet units;
  CodeSet distance;
  CodeSet length;
  CodeSet compensation;
  CodeSet rotation;
  std::optional<double> feed; // one number in all states
};

InForce inForceIn(const MotionView &view, const AbstractState &state) {
  const auto codes = [&](ModalKind kind) { return view.inForce(state, kind).value_or(CodeSet::atEntry()); };
  const AbstractValue &feed = state.word('F');
  return {codes(ModalKind::FeedMode),
          codes(ModalKind::Units),
          codes(ModalKind::Distance),
          codes(ModalKind::Length),
          codes(ModalKind::Compensation),
          codes(ModalKind::Rotation),
          feed.mayBeVacant() ? std::nullopt : feed.number().constantValue()};
}

void joinInto(std::map<NodeId, InForce> &places, NodeId node, const InForce &found) {
  const auto [known, isNew] = places.emplace(node, found);
  if (isNew)
    return;
  InForce &old = known->second;
  old = {join(old.feedMode, found.feedMode),
         join(old.units, found.units),
         join(old.distance, found.distance),
         join(old.length, found.length),
         join(old.compensation, found.compensation),
         join(old.rotation, found.rotation),
         old.feed == found.feed ? old.feed : std::nullopt};
}

class ModeChangedByCall final : public FlowRule {
public:
  ModeChangedByCall(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(!context.model.callsOf(program).empty()) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!asked_)
      return;
    if (const auto call = callBefore_.find(node); call != callBefore_.end())
      joinInto(after_, call->second, isHavocked(state) ? InForce{} : inForceIn(view_, state));
    if (!std::holds_alternative<CallProgram>(view_.node(node).instruction))
      return;
    joinInto(before_, node, inForceIn(view_, state));
    callBefore_.emplace(view_.node(node).next, node);
  }

  void after(NodeId node, const AbstractState &state) override {
    if (!after_.empty() && !view_.modalMotionWords(node).empty())
      noteMove(node, state);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    std::ranges::sort(moves_);
    std::ranges::sort(feeds_);
    std::ranges::sort(numberedFeeds_);
    std::ranges::sort(cuts_);
    std::ranges::sort(inLength_);
    std::ranges::sort(literals_);
    for (const auto &entry : after_) {
      const NodeId call = entry.first;
      const InForce &later = entry.second;
      const InForce &earlier = before_.at(call);
      const auto code = [&](ModalKind kind, CodeSet was, CodeSet is, const std::vector<NodeId> &uses) {
        if (was.isSingle() && is.isSingle() && was != is)
          tell(
              call, uses, fmt::format("`{}`, not `{}`", nameOf(kind, is), nameOf(kind, was)),
              [&](NodeId node) { return view_.sets(node, kind); }, facts, context, reporter);
      };
      code(ModalKind::Units, earlier.units, later.units, moves_);
      code(ModalKind::FeedMode, earlier.feedMode, later.feedMode, feedsOf(later.feedMode));
      const auto cancelled = [&](ModalKind kind, CodeSet was, CodeSet is, std::initializer_list<CodeAction> off,
                                 const std::vector<NodeId> &uses) {
        const CodeMask mask = view_.modes().groupOf(kind) ? view_.modes().maskOf(kind, off) : 0;
        if ((is.codes() & mask) != 0 && (was.codes() & mask) == 0)
          code(kind, was, is, uses);
      };
      if (isAbsolute(earlier.distance))
        code(ModalKind::Distance, earlier.distance, later.distance, literals_);
      cancelled(ModalKind::Length, earlier.length, later.length, {CodeAction::LengthOff}, inLength_);
      cancelled(ModalKind::Compensation, earlier.compensation, later.compensation, {CodeAction::CompensationOff},
                cuts_);
      cancelled(ModalKind::Rotation, earlier.rotation, later.rotation, {CodeAction::RotationOff}, cuts_);
      if (earlier.feed && later.feed && earlier.feed != later.feed)
        tellFeed(call, *earlier.feed, *later.feed, facts, context, reporter);
    }
  }

private:
  std::string nameOf(ModalKind kind, CodeSet only) const {
    const auto &codes = view_.modes().group(*view_.modes().groupOf(kind)).codes;
    const auto index = static_cast<std::size_t>(std::countr_zero(only.codes()));
    return fmt::format("G{}", codes[index]->tenths / 10);
  }
  bool isAbsolute(CodeSet distance) const {
    const bool hasGroup = view_.modes().groupOf(ModalKind::Distance).has_value();
    return hasGroup && distance.codes() == view_.modes().maskOf(ModalKind::Distance, {CodeAction::Absolute});
  }
  /// A block with an F of its own counts where the number fits the other mode only: 5 mm per revolution is too much for
  /// any tool, and 1 mm per minute too little.
  std::vector<NodeId> feedsOf(CodeSet mode) const {
    constexpr double kMostPerRevolution = 5;
    constexpr double kLeastPerMinute = 1;
    const auto group = view_.modes().groupOf(ModalKind::FeedMode);
    const bool perRevolution =
        group && (mode.codes() & view_.modes().maskOf(ModalKind::FeedMode, {CodeAction::FeedPerRevolution})) != 0;
    std::vector<NodeId> nodes = feeds_;
    for (const auto &[node, feed] : numberedFeeds_)
      if (perRevolution ? feed > kMostPerRevolution : feed > 0 && feed < kLeastPerMinute)
        nodes.push_back(node);
    std::ranges::sort(nodes);
    return nodes;
  }
  /// What is computed may be a distance on purpose, and a way up ends above the part in either mode.
  bool goesToNumber(NodeId node) const {
    return std::ranges::any_of(view_.modalMotionWords(node), [](const Word *word) {
      return word->isNumber() && !word->number().isZero() && (word->address() != 'Z' || word->number().isNegative());
    });
  }
  void noteMove(NodeId node, const AbstractState &state) {
    moves_.push_back(node);
    if (goesToNumber(node))
      literals_.push_back(node);
    if (view_.mayHave(node, 'Z'))
      inLength_.push_back(node);
    if ((view_.mayHave(node, 'X') || view_.mayHave(node, 'Y')) && view_.surely(state, ModalKind::Motion, kFeeding))
      cuts_.push_back(node);
    if (const AbstractValue &feed = state.word('F');
        view_.mayHave(node, 'F') && view_.surely(state, ModalKind::Motion, kFeeding) && feed.isNumber())
      if (const auto number = feed.number().constantValue())
        numberedFeeds_.emplace_back(node, *number);
    if (!view_.mayHave(node, 'F') && view_.surely(state, ModalKind::Motion, kFeeding) &&
        !view_.mayBe(state, ModalKind::Cycle, {CodeAction::OtherCycle}))
      feeds_.push_back(node);
  }

  void tellFeed(NodeId call, double was, double is, const FlowFacts &facts, const FileContext &context,
                const Reporter &reporter) const {
    const auto writesFeed = [&](NodeId node) { return view_.mayHave(node, 'F'); };
    tell(call, feeds_, fmt::format("`F{:g}`, not `F{:g}`", is, was), writesFeed, facts, context, reporter);
  }

  template <typename Blocks>
  void tell(NodeId call, const std::vector<NodeId> &uses, const std::string &what, Blocks &&blocks,
            const FlowFacts &facts, const FileContext &context, const Reporter &reporter) const {
    const auto use = firstReached(facts, call, uses, blocks);
    if (!use)
      return;
    const Word &word = *view_.modalMotionWords(*use).front();
    reporter.report({.message = fmt::format("{} moves with {}", context.quoted(word.span()), what),
                     .span = word.span(),
                     .labels = {{view_.blockSpan(call), "the called program returns with another one"}},
                     .flow = describePath(facts, *findPath(facts, call, *use, blocks)),
                     .notes = {"a called program changes F and modal codes for its caller, too",
                               "program them again behind the call, or restore them in the called program"}});
  }

  MotionView view_;
  bool asked_;
  std::map<NodeId, NodeId> callBefore_; // by the node to which it returns
  std::map<NodeId, InForce> before_;    // by the call
  std::map<NodeId, InForce> after_;
  std::vector<NodeId> moves_;
  std::vector<NodeId> feeds_; // without F
  std::vector<std::pair<NodeId, double>> numberedFeeds_;
  std::vector<NodeId> cuts_;     // by feed in X or Y
  std::vector<NodeId> inLength_; // with a Z
  std::vector<NodeId> literals_; // to a number
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ModeChangedByCall>(program, context);
}

} // namespace

extern const Rule modeChangedByCall;
const Rule modeChangedByCall{.info = {"mode-changed-by-call", Category::Motion, Severity::Warning,
                                      "Reports a move with the feed rate or a mode that a called program has left "
                                      "instead of those of its caller."},
                             .hooks = {.watch = watch}};

} // namespace feedhold::rules::mode_changed_by_call
