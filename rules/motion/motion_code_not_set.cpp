// motion-code-not-set: axis words of a main program before any G00 to G03.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::motion_code_not_set {
namespace {

class MotionCodeNotSet final : public FlowRule {
public:
  MotionCodeNotSet(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    const auto codes = view_.inForce(state, ModalKind::Motion);
    const auto words = view_.modalMotionWords(node);
    if (!codes || !codes->mayBeAtEntry() || isHavocked(state) ||
        std::ranges::all_of(words, [](const Word *word) { return word->form() == WordForm::Missing; }))
      return;
    if (!view_.sets(node, ModalKind::Cycle) && !isInCycle(state))
      first_.note(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    if (!first_.node())
      return;
    const BlockId block = view_.node(*first_.node()).block;
    if (!context.model.callsIn(block, block.next()).empty())
      return; // arguments-of-subprogram
    const bool isMain = startedBy(context, view_.program()) == StartedBy::Operator;
    const Word &word = *view_.modalMotionWords(*first_.node()).front();
    const auto sets = [&](NodeId node) { return view_.sets(node, ModalKind::Motion); };
    reporter.report(
        {.message = fmt::format("{} comes before any `G00`, `G01`, `G02` or `G03`", context.quoted(word.span())),
         .span = word.span(),
         .flow = pathFromEntry(facts, *first_.node(), sets),
         .notes = {"the block moves like the last move before it: at rapid, at feed, or along an arc",
                   "write the motion code in this block"}},
        isMain && comesToItsEnd(facts) ? Severity::Warning : Severity::Info);
  }

private:
  /// A canned cycle that the program has begun: the block is one more hole.
  bool isInCycle(const AbstractState &state) const {
    const auto cycles = view_.inForce(state, ModalKind::Cycle);
    return cycles && !cycles->mayBeAtEntry() && !view_.mayBe(state, ModalKind::Cycle, {CodeAction::CycleOff});
  }

  MotionView view_;
  FirstSeen first_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<MotionCodeNotSet>(program, context);
}

} // namespace

extern const Rule motionCodeNotSet;
const Rule motionCodeNotSet{.info = {"motion-code-not-set", Category::Motion, Severity::Warning,
                                     "Reports the first axis words of a program when no `G00`, `G01`, `G02` or `G03` "
                                     "comes before them on some path."},
                            .hooks = {.watch = watch}};

} // namespace feedhold::rules::motion_code_not_set
