// distance-mode-not-set: axis words before any G90 or G91.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

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
    if (!view_.findAction(node, {CodeAction::MachineMove}))
      first_.note(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    if (!first_.node())
      return;
    const bool isMain = startedBy(context, view_.program()) == StartedBy::Operator;
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
    reporter.report(std::move(diagnostic),
                    isMain && !context.dialect.behaviour.endRestoresModes ? Severity::Warning : Severity::Info);
  }

private:
  MotionView view_;
  FirstSeen first_;
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
