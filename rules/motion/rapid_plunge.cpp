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
    for (const auto &[plunge, fed] : found_) {
      const Word &level = *view().modalMotionWords(plunge).front();
      const bool isInherited = !view().sets(plunge, ModalKind::Motion);
      reporter.report({.message = fmt::format("{} is reached at rapid", context.quoted(level.span())),
                       .span = level.span(),
                       .labels = {{view().modalMotionWords(fed).front()->span(), "the tool is fed to this depth here"}},
                       .notes = {"if there is material below the tool, it breaks",
                                 isInherited ? "`G00` is still active: write `G01` in this block"
                                             : "write `G01` unless the tool stands beside the part"}},
                      isInherited ? Severity::Warning : Severity::Info);
    }
  }

private:
  bool changesDepths(NodeId node) const override { return view().findAction(node, kOtherDepths) != nullptr; }
  void forget() override {
    fed_.clear();
    plunge_.reset();
    hasMoved_ = false;
  }
  void follow(const DepthMove &move) override {
    const Word *level = move.level;
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

  std::map<Decimal, NodeId> fed_; // depths, with the block that feeds to them
  bool hasMoved_ = false;         // in the plane, since the retract
  std::optional<std::pair<NodeId, NodeId>> plunge_;
  std::map<NodeId, NodeId> found_; // the rapid block, the one that feeds
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<RapidPlunge>(program, context);
}

} // namespace

extern const Rule rapidPlunge;
const Rule rapidPlunge{.info = {"rapid-plunge", Category::Motion, Severity::Warning,
                                "Reports a `Z` at rapid to a depth to which the same tool is fed elsewhere, when a cut "
                                "follows."},
                       .hooks = {.watch = watch}};

} // namespace feedhold::rules::rapid_plunge
