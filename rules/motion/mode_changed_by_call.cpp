// mode-changed-by-call: a called program returns with another F, G94, G95, G20 or G21 than it was called with.
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
  std::optional<double> feed; // one number in all states
};

InForce inForceIn(const MotionView &view, const AbstractState &state) {
  const auto codes = [&](ModalKind kind) { return view.inForce(state, kind).value_or(CodeSet::atEntry()); };
  const AbstractValue &feed = state.word('F');
  return {codes(ModalKind::FeedMode), codes(ModalKind::Units),
          feed.mayBeVacant() ? std::nullopt : feed.number().constantValue()};
}

void joinInto(std::map<NodeId, InForce> &places, NodeId node, const InForce &found) {
  const auto [known, isNew] = places.emplace(node, found);
  if (isNew)
    return;
  InForce &old = known->second;
  old = {join(old.feedMode, found.feedMode), join(old.units, found.units),
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
      code(ModalKind::FeedMode, earlier.feedMode, later.feedMode, feeds_);
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
  void noteMove(NodeId node, const AbstractState &state) {
    moves_.push_back(node);
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
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ModeChangedByCall>(program, context);
}

} // namespace

extern const Rule modeChangedByCall;
const Rule modeChangedByCall{.info = {"mode-changed-by-call", Category::Motion, Severity::Warning,
                                      "Reports a move with the feed rate, the feed mode or the units that a called "
                                      "program has left instead of those of its caller."},
                             .hooks = {.watch = watch}};

} // namespace feedhold::rules::mode_changed_by_call
