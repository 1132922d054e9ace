// rapid-plunge: `Z-3.` under G00 at a new place, to a depth to which the tool is fed elsewhere.
#include "rules/motion/depth_walk.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace feedhold::rules::rapid_plunge {
namespace {

constexpr std::initializer_list<CodeAction> kOtherDepths = {
    CodeAction::ToolChange, CodeAction::LengthPlus, CodeAction::LengthMinus,   CodeAction::LengthOff,
    CodeAction::WorkOffset, CodeAction::LocalShift, CodeAction::CoordinateSet, CodeAction::ExtendedWorkOffset};

class RapidPlunge final : public DepthWalk {
public:
  using DepthWalk::DepthWalk;

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[plunge, fed] : tooDeep_) {
      const Word &level = *view().modalMotionWords(plunge).front();
      reporter.report({.message = fmt::format("{} is reached at rapid, and the cut behind it begins higher",
                                              context.quoted(level.span())),
                       .span = level.span(),
                       .labels = {{view().modalMotionWords(fed).front()->span(), "the tool is fed up to here"}},
                       .notes = {"if there is material below the tool, it breaks",
                                 "check the sign of this Z: a level above the part is meant before the plunge"}});
    }
    for (const auto &[plunge, fed] : found_) {
      const Word &level = *view().modalMotionWords(plunge).front();
      const bool isInherited = !view().sets(plunge, ModalKind::Motion);
      reporter.report({.message = fmt::format("{} is reached at rapid", context.quoted(level.span())),
                       .span = level.span(),
                       .labels = {{view().modalMotionWords(fed).front()->span(), "the tool is fed to this depth here"}},
                       .notes = {"if there is material below the tool, it breaks",
                                 isInherited ? "`G00` is still active: write `G01` in this block"
                                             : "write `G01` unless the tool stands beside the part"}},
                      isInherited && entries_.size() < kHabit ? Severity::Warning : Severity::Info);
    }
  }

private:
  bool changesDepths(NodeId node) const override { return view().findAction(node, kOtherDepths) != nullptr; }
  void forget() override {
    fed_.clear();
    plunge_.reset();
    below_.reset();
    fedUp_.reset();
    entry_.reset();
    hasMoved_ = false;
  }
  void follow(const DepthMove &move) override {
    const Word *level = move.level;
    followDown(move);
    noteEntry(move);
    const auto fed = level ? fed_.find(level->number()) : fed_.end();
    if (plunge_ && move.feeds && !level) // a cut at this depth
      found_.insert(*plunge_);
    plunge_.reset();
    if (!level) {
      hasMoved_ = true;
      return;
    }
    if (move.feeds && move.isAlone && level->number().isNegative())
      fed_.emplace(level->number(), move.node);
    else if (!move.feeds && move.isAlone && hasMoved_ && fed != fed_.end())
      plunge_ = {move.node, fed->second};
    if (!level->number().isNegative())
      hasMoved_ = false;
  }

  /// `G00 Z-3.`, and a cut in the plane from there.
  void noteEntry(const DepthMove &move) {
    if (entry_ && move.feeds && !move.level)
      entries_.insert(*entry_);
    entry_.reset();
    if (!move.feeds && move.isAlone && move.level && move.level->number().isNegative())
      entry_ = move.node;
  }
  /// `G00 Z-15.`, `G01 Z-5.`, and a cut in the plane.
  void followDown(const DepthMove &move) {
    if (fedUp_ && move.feeds && !move.level)
      tooDeep_.emplace(below_->first, *fedUp_);
    fedUp_.reset();
    const bool isUp = below_ && move.feeds && move.isAlone && move.level && move.level->number().isNegative() &&
                      below_->second->number() < move.level->number();
    if (isUp)
      fedUp_ = move.node;
    else if (!move.feeds && move.isAlone && move.level && move.level->number().isNegative() && !isDeep_)
      below_ = {move.node, move.level};
    else
      below_.reset();
    if (move.level)
      isDeep_ = move.level->number().isNegative();
  }

  /// Whoever enters so that often does it beside the part.
  static constexpr std::size_t kHabit = 3;

  std::optional<NodeId> entry_;                          // the last move, at rapid and down
  std::set<NodeId> entries_;                             // such moves with a cut behind them
  std::optional<std::pair<NodeId, const Word *>> below_; // the last move, at rapid
  std::optional<NodeId> fedUp_;                          // the last move, above it
  bool isDeep_ = false;                                  // before the move
  std::map<NodeId, NodeId> tooDeep_;                     // the rapid block, the one that feeds up
  std::map<Decimal, NodeId> fed_;                        // depths, with the block that feeds to them
  bool hasMoved_ = false;                                // in the plane, since the retract
  std::optional<std::pair<NodeId, NodeId>> plunge_;
  std::map<NodeId, NodeId> found_; // the rapid block, the one that feeds
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<RapidPlunge>(program, context);
}

} // namespace

extern const Rule rapidPlunge;
const Rule rapidPlunge{.info = {"rapid-plunge", Category::Motion, Severity::Warning,
                                "Reports a `Z` at rapid to a depth to which the same tool is fed elsewhere, or from "
                                "which it is fed up, when a cut follows."},
                       .hooks = {.watch = watch}};

} // namespace feedhold::rules::rapid_plunge
