// retract-into-part: `G01 Z-5.`, a cut, `G00 Z-50.`, and a rapid move in the plane.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace feedhold::rules::retract_into_part {
namespace {

constexpr std::initializer_list<CodeAction> kFeeding = {CodeAction::Linear, CodeAction::ArcClockwise,
                                                        CodeAction::ArcCounterclockwise};
constexpr std::initializer_list<CodeAction> kLeaving = {CodeAction::ToolChange, CodeAction::ReferenceReturn};
constexpr std::initializer_list<CodeAction> kOtherDepths = {
    CodeAction::LengthPlus, CodeAction::LengthMinus,   CodeAction::LengthOff,          CodeAction::WorkOffset,
    CodeAction::LocalShift, CodeAction::CoordinateSet, CodeAction::ExtendedWorkOffset, CodeAction::MachineMove};

/// Follows the depth through blocks that stand one behind the other.
class RetractIntoPart final : public FlowRule {
public:
  RetractIntoPart(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(context.dialect.machine == MachineKind::Milling) {}

  void before(NodeId node, const AbstractState &) override {
    if (asked_ && node == next_ && std::holds_alternative<EndProgram>(view_.node(node).instruction))
      leave();
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!asked_)
      return;
    const bool isNext = node == next_;
    next_ = node.next();
    const auto &instruction = view_.node(node).instruction;
    if (isNext && std::holds_alternative<Pass>(instruction))
      return;
    if (!isNext || !std::holds_alternative<ExecuteWords>(instruction) || view_.findAction(node, kOtherDepths))
      return forget();
    if (view_.findAction(node, kLeaving))
      return leave();
    const auto words = view_.modalMotionWords(node);
    if (words.empty()) {
      if (!view_.axisWords(node).empty())
        forget();
      return;
    }
    if (!view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}) ||
        !view_.surely(state, ModalKind::Cycle, {CodeAction::CycleOff}) ||
        view_.wasSet(state, ModalKind::Plane, {CodeAction::PlaneZX, CodeAction::PlaneYZ}))
      return forget();
    follow(node, state, words);
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[retract, depth] : found_) {
      const Word &level = *view_.modalMotionWords(retract).front();
      reporter.report({.message = fmt::format("{} goes deeper than the cut at rapid, and no cut follows",
                                              context.quoted(level.span())),
                       .span = level.span(),
                       .labels = {{depth->span(), "the depth of the cut"}},
                       .notes = {"the tool is driven into the part, the fixture or the table",
                                 "check the sign of this Z: a retract is meant"}});
    }
  }

private:
  void forget() {
    depth_ = nullptr;
    retract_.reset();
  }
  /// What follows is no cut.
  void leave() {
    if (retract_)
      found_.emplace(retract_->node, depth_);
    forget();
  }
  void follow(NodeId node, const AbstractState &state, const std::vector<const Word *> &words) {
    const auto found = std::ranges::find(words, 'Z', [](const Word *word) { return word->address(); });
    const Word *level = found == words.end() ? nullptr : *found;
    const bool isRapid = view_.surely(state, ModalKind::Motion, {CodeAction::Rapid});
    const bool feeds = view_.surely(state, ModalKind::Motion, kFeeding);
    if ((!isRapid && !feeds) || (level && !level->isNumber()))
      return forget();
    if (retract_)
      return followRetract(level, feeds);
    if (isRapid && depth_ && level && words.size() == 1 && level->number() < depth_->number())
      retract_ = Retract{node, level};
    else if (level)
      depth_ = feeds && level->number().isNegative() ? level : nullptr;
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

  MotionView view_;
  bool asked_;
  NodeId next_{0};
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
