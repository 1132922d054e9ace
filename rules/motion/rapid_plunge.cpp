// rapid-plunge: `Z-3.` under G00 at a new place, to a depth to which the tool is fed elsewhere.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace feedhold::rules::rapid_plunge {
namespace {

constexpr std::initializer_list<CodeAction> kFeeding = {CodeAction::Linear, CodeAction::ArcClockwise,
                                                        CodeAction::ArcCounterclockwise};
constexpr std::initializer_list<CodeAction> kOtherDepths = {
    CodeAction::ToolChange, CodeAction::LengthPlus, CodeAction::LengthMinus,   CodeAction::LengthOff,
    CodeAction::WorkOffset, CodeAction::LocalShift, CodeAction::CoordinateSet, CodeAction::ExtendedWorkOffset};

/// Follows Z through blocks that stand one behind the other.
class RapidPlunge final : public FlowRule {
public:
  RapidPlunge(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(context.dialect.machine == MachineKind::Milling) {}

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
    for (const auto &[plunge, fed] : found_) {
      const Word &level = *view_.modalMotionWords(plunge).front();
      const bool isInherited = !view_.sets(plunge, ModalKind::Motion);
      reporter.report({.message = fmt::format("{} is reached at rapid", context.quoted(level.span())),
                       .span = level.span(),
                       .labels = {{view_.modalMotionWords(fed).front()->span(), "the tool is fed to this depth here"}},
                       .notes = {"if there is material below the tool, it breaks",
                                 isInherited ? "`G00` is still active: write `G01` in this block"
                                             : "write `G01` unless the tool stands beside the part"}},
                      isInherited ? Severity::Warning : Severity::Info);
    }
  }

private:
  void forget() {
    fed_.clear();
    plunge_.reset();
    hasMoved_ = false;
  }
  void follow(NodeId node, const AbstractState &state, const std::vector<const Word *> &words) {
    const auto depth = std::ranges::find(words, 'Z', [](const Word *word) { return word->address(); });
    const Word *level = depth == words.end() ? nullptr : *depth;
    const bool isRapid = view_.surely(state, ModalKind::Motion, {CodeAction::Rapid});
    const bool feeds = view_.surely(state, ModalKind::Motion, kFeeding);
    if ((!isRapid && !feeds) || (level && !level->isNumber()))
      return forget();
    const auto fed = level ? fed_.find(level->number()) : fed_.end();
    if (plunge_ && feeds && !level) // a cut at this depth
      found_.insert(*plunge_);
    plunge_.reset();
    if (!level) {
      hasMoved_ = true;
      return;
    }
    if (feeds && words.size() == 1 && level->number().isNegative())
      fed_.emplace(level->number(), node);
    else if (isRapid && words.size() == 1 && hasMoved_ && fed != fed_.end())
      plunge_ = {node, fed->second};
    if (!level->number().isNegative())
      hasMoved_ = false;
  }

  MotionView view_;
  bool asked_;
  NodeId next_{0};
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
