// inherited-cycle: `Z50.` behind G81: no retract, but another hole.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::inherited_cycle {
namespace {

constexpr std::initializer_list<CodeAction> kDrilling = {
    CodeAction::CycleDrill,    CodeAction::CycleDwell,      CodeAction::CyclePeck,      CodeAction::CycleChipBreak,
    CodeAction::CycleTap,      CodeAction::CycleTapLeft,    CodeAction::CycleBore,      CodeAction::CycleBoreStop,
    CodeAction::CycleBackBore, CodeAction::CycleBoreManual, CodeAction::CycleBoreDwell, CodeAction::CycleFineBore};

class InheritedCycle final : public FlowRule {
public:
  InheritedCycle(ProgramId program, const FileContext &context) : view_(program, context) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!isHavocked(state) && view_.wasSet(state, ModalKind::Cycle, kDrilling) &&
        view_.surely(state, ModalKind::Cycle, kDrilling) &&
        view_.surely(state, ModalKind::Plane, {CodeAction::PlaneXY}) && isDepthAlone(node))
      places_.insert(node);
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const NodeId node : places_) {
      const Word &word = *view_.modalMotionWords(node).front();
      reporter.report(
          {.message = fmt::format("{} drills again here: a canned cycle is still active", context.quoted(word.span())),
           .span = word.span(),
           .notes = {"the cycle takes Z as its new depth and feeds to it",
                     "to retract, write G80 before this block or G00 in it"}});
    }
  }

private:
  /// Z, and nothing that says where or how to drill.
  bool isDepthAlone(NodeId node) const {
    const auto words = view_.wordsOf(node);
    return !view_.sets(node, ModalKind::Motion) && !view_.sets(node, ModalKind::Cycle) &&
           view_.modalMotionWords(node).size() == 1 && view_.modalMotionWords(node).front()->address() == 'Z' &&
           std::ranges::none_of(words, [](const Word *word) {
             return std::string_view("GRQPKLIJ").find(word->address()) != std::string_view::npos;
           });
  }

  MotionView view_;
  std::set<NodeId> places_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<InheritedCycle>(program, context);
}

} // namespace

extern const Rule inheritedCycle;
const Rule inheritedCycle{.info = {"inherited-cycle", Category::Motion, Severity::Warning,
                                   "Reports a block with only a `Z` while a drilling cycle is still active."},
                          .hooks = {.watch = watch}};

} // namespace feedhold::rules::inherited_cycle
