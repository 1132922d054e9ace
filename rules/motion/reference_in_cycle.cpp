// reference-in-cycle: `G83 ..`, and `G28 Z0` before any `G80`.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::reference_in_cycle {
namespace {

class ReferenceInCycle final : public FlowRule {
public:
  ReferenceInCycle(ProgramId program, const FileContext &context)
      : view_(program, context),
        asked_(context.dialect.hasFanucParameters && context.dialect.machine == MachineKind::Milling) {}

  void before(NodeId node, const AbstractState &state) override {
    const Word *code = asked_ ? referenceIn(node) : nullptr;
    if (!code || endsCycle(node))
      return;
    const bool isActive = !isHavocked(state) && view_.surely(state, ModalKind::Cycle, kCycles);
    const auto [at, isNew] = places_.emplace(node, isActive ? code : nullptr);
    if (!isNew && !isActive)
      at->second = nullptr;
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, code] : places_)
      if (code)
        reporter.report({.message = fmt::format("{} while a canned cycle is active", context.quoted(code->span())),
                         .span = code->span(),
                         .flow = pathFromEntry(facts, node),
                         .notes = {"the control stops with PS0044 (G27 to G30 not allowed in a canned cycle)",
                                   "write `G80` before it, or in its block"}});
  }

private:
  static constexpr std::initializer_list<CodeAction> kCycles = {
      CodeAction::CycleDrill,    CodeAction::CycleDwell,      CodeAction::CyclePeck,      CodeAction::CycleChipBreak,
      CodeAction::CycleTap,      CodeAction::CycleTapLeft,    CodeAction::CycleBore,      CodeAction::CycleBoreStop,
      CodeAction::CycleBackBore, CodeAction::CycleBoreManual, CodeAction::CycleBoreDwell, CodeAction::CycleFineBore};

  const Word *referenceIn(NodeId node) const {
    if (!view_.mayHave(node, 'G'))
      return nullptr;
    for (const Word *word : view_.wordsOf(node))
      if (const Code *code = codeOf(*word, view_.context().dialect); code && code->role == CodeRole::ReferenceReturn)
        return word;
    return nullptr;
  }
  bool endsCycle(NodeId node) const {
    return view_.sets(node, ModalKind::Cycle) || view_.sets(node, ModalKind::Motion);
  }

  MotionView view_;
  bool asked_;
  std::map<NodeId, const Word *> places_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ReferenceInCycle>(program, context);
}

} // namespace

extern const Rule referenceInCycle;
const Rule referenceInCycle{.info = {"reference-in-cycle", Category::Motion, Severity::Error,
                                     "Reports `G27` to `G30` while a canned cycle is active."},
                            .hooks = {.watch = watch}};

} // namespace feedhold::rules::reference_in_cycle
