// rapid-at-depth: G00 in the plane at the depth of the last cut, then a feed to the depth that the tool already has, or
// by a distance still deeper; a drilling cycle that goes to its hole from there.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace feedhold::rules::rapid_at_depth {
namespace {

constexpr std::initializer_list<CodeAction> kFeeding = {CodeAction::Linear, CodeAction::ArcClockwise,
                                                        CodeAction::ArcCounterclockwise};

/// Follows the depth through blocks that stand one behind the other.
class RapidAtDepth final : public FlowRule {
public:
  RapidAtDepth(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(context.dialect.machine == MachineKind::Milling) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!asked_)
      return;
    if (node != next_)
      forget();
    next_ = node.next();
    if (!std::holds_alternative<ExecuteWords>(view_.node(node).instruction)) {
      if (!std::holds_alternative<Pass>(view_.node(node).instruction))
        forget();
      return;
    }
    const auto words = view_.modalMotionWords(node);
    if (view_.mayHave(node, 'M')) // M05, M19: a boring bar is moved off its bore
      plunged_.reset();
    if (words.empty())
      return afterNoMove(node);
    if (const Word *cycle = view_.findAction(node, kDrillingCycles)) {
      if (depth_ && !isIncremental_ && drills(node, state) && leavesPlace(words))
        cycles_.emplace(node, Cycle{cycle, *depthAt_});
      return forget();
    }
    const auto depth = std::ranges::find(words, 'Z', [](const Word *word) { return word->address(); });
    const Word *level = depth == words.end() ? nullptr : *depth;
    const bool isIncremental = view_.surely(state, ModalKind::Distance, {CodeAction::Incremental});
    if (isIncremental != std::exchange(isIncremental_, isIncremental))
      forget();
    const bool isAbove = isIncremental && state.at(Axis::Z).number().interval().lo > 0;
    if ((level && !level->isNumber()) || isAbove ||
        (!isIncremental && !view_.surely(state, ModalKind::Distance, {CodeAction::Absolute})) || isInCycle(state) ||
        view_.wasSet(state, ModalKind::Plane, {CodeAction::PlaneZX, CodeAction::PlaneYZ}))
      return forget();
    if (view_.surely(state, ModalKind::Motion, {CodeAction::Rapid})) {
      if (!standsAt(words))
        afterRapid(node, level);
      return goTo(words);
    }
    if (!view_.surely(state, ModalKind::Motion, kFeeding))
      return forget();
    afterFeed(node, level, words.size() == 1);
    goTo(words);
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, cycle] : cycles_)
      reporter.report({.message = fmt::format("{} goes to its first hole at rapid at the depth of the last cut",
                                              context.quoted(cycle.code->span())),
                       .span = cycle.code->span(),
                       .labels = {{view_.modalMotionWords(cycle.cut).front()->span(), "the last depth"}},
                       .notes = {"a cycle moves in the plane before it goes to its R: the tool goes through the part",
                                 "retract in Z before this block"}});
    for (const auto &[rapid, plunge] : behindPlunge_) {
      const Word &first = *view_.modalMotionWords(rapid).front();
      if (!found_.contains(rapid))
        reporter.report({.message = fmt::format("{} moves at rapid right behind the plunge, at the depth of the cut",
                                                context.quoted(first.span())),
                         .span = first.span(),
                         .labels = {{view_.modalMotionWords(plunge).front()->span(), "the plunge"}},
                         .notes = {"the tool goes through the part at rapid",
                                   "retract in Z before this block, or write `G01` and F for the cut"}});
    }
    for (const auto &[rapid, plunge] : found_) {
      const Word &first = *view_.modalMotionWords(rapid).front();
      const Word &level = *view_.modalMotionWords(plunge.node).front();
      reporter.report(
          {.message = fmt::format("{} moves at rapid at the depth of the cut", context.quoted(first.span())),
           .span = first.span(),
           .labels = {{level.span(),
                       plunge.deeper ? "feeds deeper from there" : "feeds to the depth that the tool already has"}},
           .notes = {"the tool goes through the part at rapid", "retract in Z before this block"}});
    }
  }

private:
  void forget() {
    forgetDepth();
    level_.reset();
    place_.clear();
  }
  void forgetDepth() {
    depth_.reset();
    plunged_.reset();
    rapid_.reset();
  }
  void goTo(const std::vector<const Word *> &words) {
    if (isIncremental_)
      return;
    for (const Word *word : words)
      if (word->isNumber())
        place_.insert_or_assign(word->address(), word->number());
      else
        place_.erase(word->address());
  }
  /// The block moves no axis.
  bool standsAt(const std::vector<const Word *> &words) const {
    return std::ranges::all_of(words, [&](const Word *word) {
      if (isIncremental_)
        return word->isNumber() && word->number().isZero();
      const auto known = place_.find(word->address());
      return word->isNumber() && known != place_.end() && known->second == word->number();
    });
  }
  /// In absolute coordinates, in XY, and not only stored: K0, L0.
  bool drills(NodeId node, const AbstractState &state) const {
    const auto words = view_.wordsOf(node);
    const bool isStored = std::ranges::any_of(words, [](const Word *word) {
      return (word->address() == 'K' || word->address() == 'L') && !(word->isNumber() && !word->number().isZero());
    });
    return !isStored && view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}) &&
           !view_.wasSet(state, ModalKind::Plane, {CodeAction::PlaneZX, CodeAction::PlaneYZ});
  }
  /// In the plane, by a coordinate that the last blocks have given otherwise.
  bool leavesPlace(const std::vector<const Word *> &words) const {
    return std::ranges::any_of(words, [&](const Word *word) {
      const auto known = place_.find(word->address());
      return (word->address() == 'X' || word->address() == 'Y') && word->isNumber() && known != place_.end() &&
             known->second != word->number();
    });
  }
  /// A code that moves by itself, changes the tool or its length, or the coordinates.
  void afterNoMove(NodeId node) {
    if (!view_.axisWords(node).empty() ||
        view_.findAction(node, {CodeAction::ToolChange, CodeAction::WorkOffset, CodeAction::LocalShift,
                                CodeAction::CoordinateSet, CodeAction::ReferenceReturn, CodeAction::MachineMove}))
      forget();
    else if (view_.findAction(node, {CodeAction::LengthPlus, CodeAction::LengthMinus, CodeAction::LengthOff}))
      forgetDepth();
  }
  void afterRapid(NodeId node, const Word *level) {
    if (level) {
      level_ = level->number();
      return forgetDepth();
    }
    if (plunged_)
      behindPlunge_.emplace(node, *plunged_);
    plunged_.reset();
    rapid_ = depth_ ? std::optional(node) : std::nullopt;
  }
  void afterFeed(NodeId node, const Word *level, bool isAlone) {
    if (rapid_ && level && isAlone && (isIncremental_ ? level->number().isNegative() : level->number() == *depth_))
      found_.emplace(*rapid_, Plunge{node, isIncremental_});
    rapid_.reset();
    plunged_.reset();
    if (level && isAlone && !isIncremental_ && level->number().isNegative() && level_ && level->number() < *level_)
      plunged_ = node;
    if (level)
      level_ = level->number();
    if (level) {
      depth_ = level->number().isNegative() ? std::optional(level->number()) : std::nullopt;
      depthAt_ = node;
    }
  }
  bool isInCycle(const AbstractState &state) const {
    const auto codes = view_.inForce(state, ModalKind::Cycle);
    return codes && (codes->codes() & ~view_.modes().maskOf(ModalKind::Cycle, {CodeAction::CycleOff})) != 0;
  }

  struct Cycle {
    const Word *code;
    NodeId cut; // the feed to the depth
  };
  /// The feed behind the rapid move.
  struct Plunge {
    NodeId node;
    bool deeper; // by a distance; else to the same depth
  };

  MotionView view_;
  bool asked_;
  bool isIncremental_ = false;
  std::optional<Decimal> level_; // the last Z
  NodeId next_{0};
  std::optional<NodeId> plunged_; // the last move: fed down from above the part
  std::map<NodeId, NodeId> behindPlunge_;
  std::optional<Decimal> depth_;  // to which, or by which, the tool was fed, and where it is
  std::optional<NodeId> depthAt_; // by which block
  std::optional<NodeId> rapid_;   // the last block, at that depth
  std::map<char, Decimal> place_; // coordinates of the last blocks, by axis
  std::map<NodeId, Plunge> found_;
  std::map<NodeId, Cycle> cycles_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<RapidAtDepth>(program, context);
}

} // namespace

extern const Rule rapidAtDepth;
const Rule rapidAtDepth{
    .info = {"rapid-at-depth", Category::Motion, Severity::Warning,
             "Reports a rapid move in the plane at the depth of the last cut, when the next block feeds `Z` to the "
             "same depth, or deeper by a distance, and a drilling cycle that begins there."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::rapid_at_depth
