// compensation-at-tool-change: `M06` while G41 is in force.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::compensation_at_tool_change {
namespace {

class CompensationAtToolChange final : public FlowRule {
public:
  CompensationAtToolChange(ProgramId program, const FileContext &context)
      : view_(program, context), turns_(context.dialect.machine == MachineKind::Turning) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!changeAt(node))
      return;
    const bool isOn = !isHavocked(state) && view_.surely(state, ModalKind::Compensation,
                                                         {CodeAction::CompensationLeft, CodeAction::CompensationRight});
    const auto [at, isNew] = seen_.emplace(node, isOn);
    if (!isNew)
      at->second = at->second && isOn;
  }
  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, isOn] : seen_) {
      if (!isOn)
        continue;
      const bool stops = context.dialect.behaviour.stopsAtStrayWords;
      const Word *change = changeAt(node);
      Diagnostic diagnostic{.message = fmt::format("{} changes the tool while {} compensation is active",
                                                   context.quoted(change->span()), turns_ ? "nose radius" : "cutter"),
                            .span = change->span(),
                            .flow = pathFromEntry(facts, node),
                            .notes = {stops    ? "the control stops with an error"
                                      : turns_ ? "the next tool is compensated, too, on the side that this one needed"
                                               : "the control stops, or moves the next tool by the radius of this one",
                                      "cancel it with G40 in a move away from the part"}};
      if (const Word *start = startBefore(node))
        diagnostic.labels = {{start->span(), "started here"}};
      reporter.report(std::move(diagnostic), stops ? Severity::Error : Severity::Warning);
      return;
    }
  }

private:
  /// M06, or on a lathe `T0303`.  LinuxCNC changes a number with M61, and no tool.
  const Word *changeAt(NodeId node) const {
    if (turns_)
      return view_.mayHave(node, 'T') ? turretWord(node) : nullptr;
    const Word *change = view_.mayHave(node, 'M') ? view_.findAction(node, {CodeAction::ToolChange}) : nullptr;
    const bool isOther = view_.context().dialect.behaviour.stopsAtStrayWords && change && change->tenths() != 60;
    return isOther ? nullptr : change;
  }
  const Word *turretWord(NodeId node) const {
    constexpr std::uint32_t kOffsets = 100; // T0300 ends the offset of tool 3
    for (const Word *word : view_.wordsOf(node))
      if (word->address() == 'T' && word->integer().value_or(0) > kOffsets && *word->integer() % kOffsets != 0)
        return word;
    return nullptr;
  }
  /// The last one in the text before the change.
  const Word *startBefore(NodeId change) const {
    for (NodeId node = change; node.index() > 0;) {
      node = NodeId(node.index() - 1);
      if (const Word *start = view_.findAction(node, {CodeAction::CompensationLeft, CodeAction::CompensationRight}))
        return start;
    }
    return nullptr;
  }

  MotionView view_;
  bool turns_;
  std::map<NodeId, bool> seen_; // on all paths
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CompensationAtToolChange>(program, context);
}

} // namespace

extern const Rule compensationAtToolChange;
const Rule compensationAtToolChange{.info = {"compensation-at-tool-change", Category::Motion, Severity::Warning,
                                             "Reports a tool change while cutter compensation is active."},
                                    .hooks = {.watch = watch}};

} // namespace feedhold::rules::compensation_at_tool_change
