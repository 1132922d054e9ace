// speed-not-set: `M03`, and no S in the whole program.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::speed_not_set {
namespace {

class SpeedNotSet final : public FlowRule {
public:
  SpeedNotSet(ProgramId program, const FileContext &context)
      : view_(program, context), isAsked_(startedBy(context, program) == StartedBy::Operator &&
                                          context.dialect.machine == MachineKind::Milling) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!isAsked_)
      return;
    mayBeSetUnseen_ = mayBeSetUnseen_ || isHavocked(state) || !isAsAtEntry(state, 'S') ||
                      std::holds_alternative<CallProgram>(view_.node(node).instruction);
    if (view_.findAction(node, {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise}))
      first_.note(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    if (!first_.node() || mayBeSetUnseen_ || !comesToItsEnd(facts) || !usesTools(facts) || hasSpeed())
      return;
    const Word *start =
        view_.findAction(*first_.node(), {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise});
    // LinuxCNC also runs routers and torches, whose speed is set by hand.
    const Severity severity = context.dialect.grammar.oWords ? Severity::Info : Severity::Warning;
    reporter.report({.message = fmt::format("{} starts the spindle, but no `S` stands in the program",
                                            context.quoted(start->span())),
                     .span = start->span(),
                     .notes = {"the spindle turns at the speed of the program that ran before, or not at all",
                               "write S in this block"}},
                    severity);
  }

private:
  /// It changes tools, or calls the length of one: no router or torch whose speed is set by hand.
  bool usesTools(const FlowFacts &facts) const {
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      if (view_.findAction(node, {CodeAction::ToolChange, CodeAction::LengthPlus}))
        return true;
    return false;
  }
  /// In the text, other programs of the file included.
  bool hasSpeed() const {
    for (NodeId node(0); node.index() < view_.cfg().nodes.size(); node = node.next())
      if (view_.mayHave(node, 'S')) {
        const auto words = view_.wordsOf(node);
        if (std::ranges::any_of(words, [](const Word *word) { return word->address() == 'S'; }))
          return true;
      }
    return false;
  }

  MotionView view_;
  bool isAsked_;
  bool mayBeSetUnseen_ = false;
  FirstSeen first_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<SpeedNotSet>(program, context);
}

} // namespace

extern const Rule speedNotSet;
const Rule speedNotSet{
    .info = {"speed-not-set", Category::Motion, Severity::Warning,
             "Reports an `M03` or `M04` of a main program that uses tools of several lengths and has no `S`."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::speed_not_set
