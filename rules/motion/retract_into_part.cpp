// retract-into-part: `G01 Z-5.`, a cut, `G00 Z-50.`, and a rapid move in the plane.
#include "rules/motion/depth_walk.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::retract_into_part {
namespace {

constexpr std::initializer_list<CodeAction> kLeaving = {CodeAction::ToolChange, CodeAction::ReferenceReturn};
constexpr std::initializer_list<CodeAction> kOtherDepths = {
    CodeAction::LengthPlus, CodeAction::LengthMinus,   CodeAction::LengthOff,          CodeAction::WorkOffset,
    CodeAction::LocalShift, CodeAction::CoordinateSet, CodeAction::ExtendedWorkOffset, CodeAction::MachineMove};

class RetractIntoPart final : public DepthWalk {
public:
  using DepthWalk::DepthWalk;

  void before(NodeId node, const AbstractState &) override {
    if (stands(node) && std::holds_alternative<EndProgram>(view().node(node).instruction))
      leave();
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[retract, depth] : found_) {
      const Word &level = *view().modalMotionWords(retract).front();
      reporter.report({.message = fmt::format("{} goes deeper than the cut at rapid, and no cut follows",
                                              context.quoted(level.span())),
                       .span = level.span(),
                       .labels = {{depth->span(), "the depth of the cut"}},
                       .notes = {"the tool is driven into the part, the fixture or the table",
                                 "check the sign of this Z: a retract is meant"}});
    }
  }

private:
  bool changesDepths(NodeId node) const override { return view().findAction(node, kOtherDepths) != nullptr; }
  bool takesAway(NodeId node) override {
    if (!view().findAction(node, kLeaving))
      return false;
    leave();
    return true;
  }
  void forget() override {
    depth_ = nullptr;
    retract_.reset();
  }
  /// What follows is no cut.
  void leave() {
    if (retract_)
      found_.emplace(retract_->node, depth_);
    forget();
  }
  void follow(const DepthMove &move) override {
    const Word *level = move.level;
    if (retract_)
      return followRetract(level, move.feeds);
    if (!move.feeds && depth_ && level && move.isAlone && level->number() < depth_->number())
      retract_ = Retract{move.node, level};
    else if (level)
      depth_ = move.feeds && level->number().isNegative() ? level : nullptr;
  }
  /// Moves in the plane may lead around the part to the next cut at this depth; a way up shows that there is none.
  void followRetract(const Word *level, bool feeds) {
    const bool goesUp = level && level->number() > retract_->level->number();
    if (!goesUp && !feeds && !level)
      return;
    if (goesUp)
      leave();
    forget();
    depth_ = feeds && level && level->number().isNegative() ? level : nullptr;
  }

  struct Retract {
    NodeId node;
    const Word *level;
  };

  const Word *depth_ = nullptr; // to which the tool was fed
  std::optional<Retract> retract_;
  std::map<NodeId, const Word *> found_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<RetractIntoPart>(program, context);
}

} // namespace

extern const Rule retractIntoPart;
const Rule retractIntoPart{.info = {"retract-into-part", Category::Motion, Severity::Warning,
                                    "Reports a `Z` at rapid below the depth of the last cut that no cut follows."},
                           .hooks = {.watch = watch}};

} // namespace feedhold::rules::retract_into_part
