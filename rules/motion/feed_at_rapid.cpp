// feed-at-rapid: `Z-2. F50.` while G00 is still active: the feed is written, and the tool moves at rapid.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace feedhold::rules::feed_at_rapid {
namespace {

constexpr std::initializer_list<CodeAction> kFeeding = {CodeAction::Linear, CodeAction::ArcClockwise,
                                                        CodeAction::ArcCounterclockwise};

/// A feed in a block that moves away from the part, or in one with `G00`, is for the blocks behind it.
class FeedAtRapid final : public FlowRule {
public:
  FeedAtRapid(ProgramId program, const FileContext &context)
      : view_(program, context), turns_(context.dialect.machine == MachineKind::Turning) {}

  void before(NodeId node, const AbstractState &state) override {
    start_ = hasBareFeed(node) ? levelOf(state) : std::nullopt;
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!hasBareFeed(node))
      return;
    const bool isRapid = !isHavocked(state) && state.modalCalls.empty() && !mayBeTrue(state.modalCallsUnknown) &&
                         view_.surely(state, ModalKind::Motion, {CodeAction::Rapid});
    const bool begins =
        view_.findAction(node, {CodeAction::CompensationLeft, CodeAction::CompensationRight}) != nullptr;
    const bool isMeant = isRapid && (begins || (turns_ ? !isForNextMove(node) : goesDown(node, state)));
    const auto [at, isNew] = seen_.emplace(node, isMeant);
    if (!isNew)
      at->second = at->second && isMeant;
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, isMeant] : seen_) {
      if (!isMeant)
        continue;
      const Word &first = *view_.modalMotionWords(node).front();
      const Word &feed = *feedOf(node);
      reporter.report(
          {.message = fmt::format("{} moves at rapid, in spite of {}: `G00` is still active",
                                  context.quoted(first.span()), context.quoted(feed.span())),
           .span = first.span(),
           .labels = {{feed.span(), "without effect on this move"}},
           .flow = pathFromEntry(facts, node),
           .notes = {"the tool runs into the part at rapid if there is material in its way",
                     "write `G01` in this block"},
           .fixes = {{.title = "insert `G01`", .edits = {{{first.span().begin, first.span().begin}, "G01 "}}}}});
    }
  }

private:
  const Word *feedOf(NodeId node) const {
    const auto words = view_.wordsOf(node);
    const auto found = std::ranges::find(words, 'F', [](const Word *word) { return word->address(); });
    return found == words.end() ? nullptr : *found;
  }
  /// Moves and has an F, and no call, G or M code that could give the words another meaning.
  bool hasBareFeed(NodeId node) const {
    const BlockId block = view_.node(node).block;
    if (!view_.mayHave(node, 'F') || view_.modalMotionWords(node).empty() ||
        !view_.context().model.callsIn(block, block.next()).empty())
      return false;
    const auto hasOwnMeaning = [&](const Word *word) {
      if (word->address() == 'F')
        return turns_ && !word->isNumber();
      return !word->isNumber() ? word->isCode() : word->isCode() && !isBeside(*word);
    };
    return feedOf(node) && std::ranges::none_of(view_.wordsOf(node), hasOwnMeaning);
  }
  /// Codes that stand in the block of a move and leave its words alone.
  bool isBeside(const Word &word) const {
    const Code *code = codeOf(word, view_.context().dialect);
    const auto is = [&](CodeAction action) { return code->action == action; };
    constexpr std::array kBeside = {
        CodeAction::Absolute,        CodeAction::Incremental,      CodeAction::CoolantOn,
        CodeAction::CoolantOff,      CodeAction::FeedPerMinute,    CodeAction::FeedPerRevolution,
        CodeAction::CompensationOff, CodeAction::LengthOff,        CodeAction::WorkOffset,
        CodeAction::CycleOff,        CodeAction::CompensationLeft, CodeAction::CompensationRight};
    return code && std::ranges::any_of(kBeside, is);
  }
  std::optional<double> levelOf(const AbstractState &state) const {
    const AbstractValue &level = state.at(Axis::Z);
    return level.isNumber() ? level.number().constantValue() : std::nullopt;
  }
  /// Below part zero, and not back up to there.
  bool goesDown(NodeId node, const AbstractState &state) const {
    if (view_.wasSet(state, ModalKind::Plane, {CodeAction::PlaneZX, CodeAction::PlaneYZ}))
      return false;
    const auto words = view_.modalMotionWords(node);
    const auto level = std::ranges::find(words, 'Z', [](const Word *word) { return word->address(); });
    if (level == words.end())
      return false;
    if (view_.surely(state, ModalKind::Distance, {CodeAction::Incremental}))
      return (*level)->isNumber() && (*level)->number().isNegative();
    const auto end = levelOf(state);
    const bool isBelow = (*level)->isNumber() ? (*level)->number().isNegative() : end && *end < 0;
    return isBelow && view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}) &&
           (!start_ || !end || *end < *start_);
  }
  /// `Z2. F0.25`, and then a `G01` that has no F: the feed is written early.
  bool isForNextMove(NodeId node) const {
    for (NodeId next = node.next(); next.index() < view_.cfg().nodes.size(); next = next.next())
      if (!view_.modalMotionWords(next).empty())
        return view_.findAction(next, kFeeding) && !feedOf(next);
    return false;
  }

  MotionView view_;
  bool turns_;
  std::optional<double> start_; // Z before the block
  std::map<NodeId, bool> seen_; // whether a cut is meant, on all paths
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<FeedAtRapid>(program, context);
}

} // namespace

extern const Rule feedAtRapid;
const Rule feedAtRapid{
    .info = {"feed-at-rapid", Category::Motion, Severity::Warning,
             "Reports a move with an `F` and without a `G01` while `G00` is active, where a cut is meant."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::feed_at_rapid
