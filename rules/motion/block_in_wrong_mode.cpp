// block-in-wrong-mode: `G53 G0 Z0` under G91, `X40` behind G80, G84 with the spindle stopped: the control refuses them.
#include "rules/flow/definitions.h"
#include "rules/flow/loop_view.h"
#include "rules/motion/ngc_block.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <string>

namespace feedhold::rules::block_in_wrong_mode {
namespace {

constexpr auto kCycles = std::to_array<std::uint16_t>({730, 740, 810, 820, 830, 840, 850, 860, 870, 880, 890});
constexpr auto kArcs = std::to_array<std::uint16_t>({20, 30});
constexpr auto kProbes = std::to_array<std::uint16_t>({382, 383, 384, 385});
constexpr auto kSplines = std::to_array<std::uint16_t>({50, 51});
constexpr auto kContours = std::to_array<std::uint16_t>({700, 710, 711, 712, 720, 721, 722});
constexpr auto kNeedSpindle = std::to_array<std::uint16_t>({330, 331, 740, 760, 840, 860, 870, 880});
constexpr auto kFeedModes = std::to_array<std::uint16_t>({940, 950});

/// What is wrong, in words.
struct Refusal {
  const Word *word;
  std::string message;
  std::string_view way;
};

template <std::size_t N> bool isIn(const std::array<std::uint16_t, N> &codes, std::uint16_t tenths) {
  return std::ranges::find(codes, tenths) != codes.end();
}

class BlockInWrongMode final : public FlowRule {
public:
  BlockInWrongMode(ProgramId program, const FileContext &context)
      : view_(program, context), isAsked_(context.dialect.behaviour.stopsAtStrayWords) {}

  void before(NodeId node, const AbstractState &state) override {
    if (isAsked_)
      note(node, [&](const NgcBlock &block) { return refusedAtStart(block, state); });
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!isAsked_ || isHavocked(state))
      return;
    note(
        node, [&](const NgcBlock &block) { return refusedAtEnd(block, state); }, after_);
    if (const auto block = NgcBlock::of(view_, node); block && cuts(*block, state))
      cuts_.emplace(node, block->axis());
  }

  void report(const FlowFacts &facts, const FileContext &, const Reporter &reporter) override {
    for (const auto &[node, refusal] : after_)
      if (refusal && !places_[node])
        places_[node] = refusal;
    for (const auto &[node, word] : cuts_)
      if (!places_[node])
        places_[node] = lacksFeed(facts, node, *word);
    bool isFeedTold = false;
    for (const auto &[node, refusal] : places_) {
      if (!refusal || (refusal->way == kWriteFeed && isFeedTold))
        continue;
      isFeedTold = isFeedTold || refusal->way == kWriteFeed;
      reporter.report({.message = refusal->message,
                       .span = refusal->word->span(),
                       .flow = pathFromEntry(facts, node),
                       .notes = {"the control stops with an error", std::string(refusal->way)}});
    }
  }

private:
  static constexpr std::string_view kWriteFeed =
      "write F in the block of the move, or behind the code of the feed mode";
  using Places = std::map<NodeId, std::optional<Refusal>>; // on all paths

  template <typename Refused> void note(NodeId node, Refused &&refused) { note(node, refused, places_); }
  template <typename Refused> void note(NodeId node, Refused &&refused, Places &places) const {
    if (const auto known = places.find(node); known != places.end() && !known->second)
      return;
    const auto block = NgcBlock::of(view_, node);
    const std::optional<Refusal> refusal = block ? refused(*block) : std::nullopt;
    const auto [at, isNew] = places.emplace(node, refusal);
    if (!isNew && !refusal)
      at->second = std::nullopt;
  }
  std::string quoted(const Word &word) const { return view_.context().quoted(word.span()); }

  /// By what is in force before the block.
  std::optional<Refusal> refusedAtStart(const NgcBlock &block, const AbstractState &state) const {
    const auto motions = motionsInForce(view_, state);
    const bool isOff = motions && std::ranges::all_of(*motions, [](std::uint16_t each) { return each == 800; });
    const bool turnsOff = block.motion() && block.motion()->tenths() == 800;
    if (block.namesAxes() && turnsOff && !block.code('G', {100, 280, 300, 520, 920}))
      return Refusal{
          block.axis(),
          fmt::format("{} stands beside {}, which ends all movement", quoted(*block.axis()), quoted(*block.motion())),
          "write the code of the movement in the place of `G80`"};
    if (block.movesByModal() && isOff)
      return Refusal{block.axis(),
                     fmt::format("{} moves by no code: `G80` has ended the last one", quoted(*block.axis())),
                     "write the code of the movement, such as `G0`, in this block"};
    if (const Word *machine = block.code('G', {530});
        machine && block.namesAxes() && !block.code('G', {900}) &&
        (block.code('G', {910}) || view_.surely(state, ModalKind::Distance, {CodeAction::Incremental})))
      return Refusal{machine, fmt::format("{} while `G91` is active", quoted(*machine)), "write `G90` in this block"};
    if (const Word *machine = block.code('G', {530});
        machine && block.movesByModal() && motions &&
        std::ranges::none_of(*motions, [](std::uint16_t each) { return each == 0 || each == 10; }))
      return Refusal{machine, fmt::format("{} moves by a code other than `G0` and `G1`", quoted(*machine)),
                     "write `G0` or `G1` in this block"};
    if (const Word *end = block.code('G', {53});
        end && motions && std::ranges::none_of(*motions, [](std::uint16_t each) { return each == 52; }))
      return Refusal{end, fmt::format("{} ends a curve that has not begun", quoted(*end)), "begin it with `G5.2`"};
    return polarRefused(block, state);
  }
  std::optional<Refusal> polarRefused(const NgcBlock &block, const AbstractState &state) const {
    const Word *polar = block.find('@') ? block.find('@') : block.find('^');
    if (!polar)
      return std::nullopt;
    const Word *beside = block.find('X') ? block.find('X') : block.find('Y');
    const Word *taker = block.code('G', {530, 920});
    if (beside || taker)
      return Refusal{polar, fmt::format("{} stands beside {}", quoted(*polar), quoted(beside ? *beside : *taker)),
                     "write either coordinates or the polar distance and angle"};
    if (view_.surely(state, ModalKind::Plane, {CodeAction::PlaneZX}) ||
        view_.surely(state, ModalKind::Plane, {CodeAction::PlaneYZ}))
      return Refusal{polar, fmt::format("{} is a polar word outside the plane of `G17`", quoted(*polar)),
                     "select `G17` before it"};
    return std::nullopt;
  }

  /// By what is in force when the block moves.
  std::optional<Refusal> refusedAtEnd(const NgcBlock &block, const AbstractState &state) const {
    if (auto refusal = planeRefused(block, state))
      return refusal;
    if (auto refusal = feedModeRefused(block, state))
      return refusal;
    return spindleRefused(block, state);
  }
  bool isOtherPlane(const AbstractState &state, CodeAction plane) const {
    return !view_.mayBe(state, ModalKind::Plane, {plane});
  }
  std::optional<Refusal> planeRefused(const NgcBlock &block, const AbstractState &state) const {
    if (const Word *spline = block.code('G', kSplines); spline && isOtherPlane(state, CodeAction::PlaneXY))
      return Refusal{spline, fmt::format("{} outside the plane of `G17`", quoted(*spline)), "select `G17` before it"};
    if (const Word *contour = block.code('G', kContours); contour && isOtherPlane(state, CodeAction::PlaneZX))
      return Refusal{contour, fmt::format("{} outside the plane of `G18`", quoted(*contour)), "select `G18` before it"};
    if (const Word *side = block.code('G', {410, 411, 420, 421});
        side && view_.surely(state, ModalKind::Plane, {CodeAction::PlaneYZ}))
      return Refusal{side, fmt::format("{} in the plane of `G19`", quoted(*side)), "select `G17` or `G18` before it"};
    if (const Word *side = block.code('G', {411, 421});
        side && block.find('L') && isOtherPlane(state, CodeAction::PlaneZX))
      return Refusal{block.find('L'),
                     fmt::format("{} beside {} outside the plane of `G18`", quoted(*block.find('L')), quoted(*side)),
                     "L is the orientation of a lathe tool: delete it, or select `G18`"};
    return arcRefused(block, state);
  }
  /// Half a centre, which G90.1 does not complete.
  std::optional<Refusal> arcRefused(const NgcBlock &block, const AbstractState &state) const {
    struct Plane {
      CodeAction action;
      std::string_view centre;
    };
    constexpr std::array kPlanes = {Plane{CodeAction::PlaneXY, "IJ"}, Plane{CodeAction::PlaneZX, "IK"},
                                    Plane{CodeAction::PlaneYZ, "JK"}};
    const Word *arc = block.code('G', kArcs);
    const auto plane = std::ranges::find_if(
        kPlanes, [&](const Plane &each) { return view_.surely(state, ModalKind::Plane, {each.action}); });
    if (!arc || plane == kPlanes.end())
      return std::nullopt;
    const auto has = [&](char letter) { return block.find(letter) != nullptr; };
    if (!has('R') && has(plane->centre[0]) != has(plane->centre[1]) &&
        view_.surely(state, ModalKind::ArcDistance, {CodeAction::ArcAbsolute}))
      return Refusal{arc,
                     fmt::format("{} has no `{}` while `G90.1` is active", quoted(*arc),
                                 plane->centre[has(plane->centre[0]) ? 1 : 0]),
                     "write both coordinates of the centre"};
    return std::nullopt;
  }
  bool isFeedMode(const AbstractState &state, CodeAction mode) const {
    return view_.surely(state, ModalKind::FeedMode, {mode});
  }
  std::optional<Refusal> feedModeRefused(const NgcBlock &block, const AbstractState &state) const {
    if (const Word *cycle = block.code('G', kCycles); cycle && isFeedMode(state, CodeAction::FeedInverse))
      return Refusal{cycle, fmt::format("{} while `G93` is active", quoted(*cycle)), "write `G94` before the cycle"};
    if (const Word *probe = block.code('G', kProbes); probe && isFeedMode(state, CodeAction::FeedPerRevolution))
      return Refusal{probe, fmt::format("{} while `G95` is active", quoted(*probe)), "write `G94` before it"};
    const bool feeds = view_.surely(state, ModalKind::Motion,
                                    {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
    if (block.namesAxes() && !block.givesAxesAway() && feeds && !block.find('F') &&
        isFeedMode(state, CodeAction::FeedInverse))
      return Refusal{block.axis(), fmt::format("the block of {} has no F while `G93` is active", quoted(*block.axis())),
                     "write the inverse of its time as F in each block that cuts"};
    const AbstractValue &speed = state.word('S');
    const bool stands = speed.isNumber() && speed.number().interval().lo == 0 && speed.number().interval().hi == 0;
    if (block.namesAxes() && !block.givesAxesAway() && feeds && stands && !block.code('G', {530}) &&
        isFeedMode(state, CodeAction::FeedPerRevolution))
      return Refusal{block.axis(), fmt::format("{} moves by the revolution, and the speed is 0", quoted(*block.axis())),
                     "write the speed as S before it, or `G94`"};
    return std::nullopt;
  }
  std::optional<Refusal> spindleRefused(const NgcBlock &block, const AbstractState &state) const {
    const Word *code = block.code('G', kNeedSpindle);
    if (!code || !block.namesAxes() || block.find('$'))
      return std::nullopt;
    const auto spindle = state.spindle.only();
    const auto action = spindle ? kSpindleActions[*spindle] : CodeAction::Unclassified;
    if (action == CodeAction::SpindleStop)
      return Refusal{code, fmt::format("{} while the spindle is stopped", quoted(*code)),
                     "start the spindle before it"};
    if (code->tenths() == 740 && action == CodeAction::SpindleClockwise)
      return Refusal{code, fmt::format("{} taps a left-hand thread, and the spindle turns clockwise", quoted(*code)),
                     "write `M4`, or `G84` for a right-hand thread"};
    if (code->tenths() == 840 && action == CodeAction::SpindleCounterclockwise)
      return Refusal{code,
                     fmt::format("{} taps a right-hand thread, and the spindle turns counterclockwise", quoted(*code)),
                     "write `M3`, or `G74` for a left-hand thread"};
    return std::nullopt;
  }

  bool cuts(const NgcBlock &block, const AbstractState &state) const {
    if (!block.namesAxes() || block.givesAxesAway() || block.find('F'))
      return false;
    const auto motions = motionsInForce(view_, state);
    return motions && !motions->empty() && std::ranges::all_of(*motions, [](std::uint16_t each) {
             return each == 10 || isIn(kArcs, each) || isIn(kCycles, each) || isIn(kProbes, each);
           });
  }
  /// G94 and G95 take the feed away, even where the mode is the same.
  std::optional<Refusal> lacksFeed(const FlowFacts &facts, NodeId node, const Word &word) const {
    constexpr int kMostNodes = 200;
    std::optional<NodeId> each = feedModeIn(node) ? node : onlyPredecessor(facts, node);
    for (int i = 0; each && i < kMostNodes; ++i, each = onlyPredecessor(facts, *each)) {
      if (!std::holds_alternative<ExecuteWords>(facts.node(*each).instruction) || view_.mayHave(*each, 'F'))
        return std::nullopt;
      if (const Word *mode = view_.mayHave(*each, 'G') ? feedModeIn(*each) : nullptr)
        return Refusal{&word, fmt::format("no feed is active: {} has ended the one before", quoted(*mode)), kWriteFeed};
    }
    return std::nullopt;
  }
  const Word *feedModeIn(NodeId node) const {
    for (const Word *word : view_.wordsOf(node))
      if (word->address() == 'G' && word->tenths() && isIn(kFeedModes, *word->tenths()))
        return word;
    return nullptr;
  }

  MotionView view_;
  bool isAsked_;
  Places places_;
  Places after_;
  std::map<NodeId, const Word *> cuts_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<BlockInWrongMode>(program, context);
}

} // namespace

extern const Rule blockInWrongMode;
const Rule blockInWrongMode{
    .info = {"block-in-wrong-mode", Category::Motion, Severity::Error,
             "Reports a block that the control does not take in the modes that are active, such as `G53` under `G91`."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::block_in_wrong_mode
