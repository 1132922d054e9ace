// distance-mode-not-set: axis words before any G90 or G91.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::distance_mode_not_set {
namespace {

class DistanceModeNotSet final : public FlowRule {
public:
  DistanceModeNotSet(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    const auto codes = view_.inForce(state, ModalKind::Distance);
    if (!codes || !codes->mayBeAtEntry() || isHavocked(state) || view_.axisWords(node).empty())
      return;
    // Machine coordinates are always absolute.
    if (view_.findAction(node, {CodeAction::MachineMove}))
      return;
    first_.note(node);
    if (isFirstWithoutMotionCode(node, state))
      withoutMotionCode_.push_back(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    if (!first_.node() || isToldOtherwise(*first_.node(), context))
      return;
    const bool isMain = startedBy(context, view_.program()) == StartedBy::Operator;
    if (isMain && context.dialect.behaviour.endRestoresModes) // it starts in G90: the start and every end see to it
      return;
    const Word &word = *view_.axisWords(*first_.node()).front();
    const auto sets = [&](NodeId node) { return view_.sets(node, ModalKind::Distance); };
    Diagnostic diagnostic{.message =
                              fmt::format("{} moves before `G90` or `G91` is programmed", context.quoted(word.span())),
                          .span = word.span(),
                          .flow = pathFromEntry(facts, *first_.node(), sets)};
    if (isMain)
      diagnostic.notes = {"the mode left by the previous program decides whether this is a position or a distance",
                          "write G90 or G91 at the head of the program"};
    else
      diagnostic.notes = {
          "the caller's mode decides whether this is a position or a distance",
          "save #4003, set G90 or G91 and restore it at the end, or state the caller's mode: `(@MODAL G90)`"};
    reporter.report(std::move(diagnostic), isMain && comesToItsEnd(facts) && mayBeLeftIncremental(context)
                                               ? Severity::Warning
                                               : Severity::Info);
  }

private:
  bool isFirstWithoutMotionCode(NodeId node, const AbstractState &state) const {
    const auto codes = view_.inForce(state, ModalKind::Motion);
    return codes && codes->mayBeAtEntry() && !view_.modalMotionWords(node).empty() &&
           !view_.sets(node, ModalKind::Cycle);
  }
  /// motion-code-not-set and arguments-of-subprogram speak of the same block.
  bool isToldOtherwise(NodeId node, const FileContext &context) const {
    const BlockId block = view_.node(node).block;
    return std::ranges::find(withoutMotionCode_, node) != withoutMotionCode_.end() ||
           !context.model.callsIn(block, block.next()).empty();
  }
  /// Some program of the folder has G91: it may be in force when this one starts.
  static bool mayBeLeftIncremental(const FileContext &context) {
    return context.programs->mayBeIncrementalInFolderOf(context.file);
  }

  MotionView view_;
  FirstSeen first_;
  std::vector<NodeId> withoutMotionCode_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<DistanceModeNotSet>(program, context);
}

} // namespace

extern const Rule distanceModeNotSet;
const Rule distanceModeNotSet{
    .info = {"distance-mode-not-set", Category::Motion, Severity::Warning,
             "Reports the first move of a program when neither `G90` nor `G91` is programmed before it on some path."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::distance_mode_not_set
