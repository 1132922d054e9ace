// incremental-move-of-zero: `G91`, and then `G00 X0 Y0`.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::incremental_move_of_zero {
namespace {

class IncrementalMoveOfZero final : public FlowRule {
public:
  IncrementalMoveOfZero(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!view_.mayHave(node, 'X') || !view_.mayHave(node, 'Y') || !isRapidOfZero(node))
      return;
    const bool isIncremental = view_.surely(state, ModalKind::Motion, {CodeAction::Rapid}) &&
                               view_.wasSet(state, ModalKind::Distance, {CodeAction::Incremental}) &&
                               view_.surely(state, ModalKind::Distance, {CodeAction::Incremental});
    (isIncremental ? zero_ : other_).insert(node);
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    if (callsAtMoves(context))
      return;
    for (const NodeId node : zero_) {
      const Word *code = other_.contains(node) ? nullptr : codeBefore(node);
      if (!code)
        continue;
      reporter.report(
          {.message = fmt::format("{} moves nothing: `G91` is active", context.quoted(view_.blockSpan(node))),
           .span = view_.blockSpan(node),
           .labels = {{code->span(), "distances from here on"}},
           .notes = {"the tool stays where it is, and does not go to X0 Y0",
                     "write `G90` for the position, or `G28` for the reference point"}});
    }
  }

private:
  /// `G66 P9100`: each move calls a macro, also one of zero.
  bool callsAtMoves(const FileContext &context) const {
    return std::ranges::any_of(context.model.callsOf(view_.program()), [](const Call &call) {
      return call.kind == CallKind::Modal || call.kind == CallKind::ModalEach;
    });
  }
  /// `G00 X0 Y0` and nothing more.
  bool isRapidOfZero(NodeId node) const {
    if (view_.modalMotionWords(node).size() != 2)
      return false;
    return std::ranges::all_of(view_.wordsOf(node), [&](const Word *word) {
      const Code *code = word->isCode() ? codeOf(*word, view_.context().dialect) : nullptr;
      switch (word->address()) {
      case 'X':
      case 'Y': return word->isNumber() && word->number().isZero();
      case 'G': return code && (code->action == CodeAction::Rapid || code->action == CodeAction::Incremental);
      default: return word->address() == 'N';
      }
    });
  }
  /// The last G91 in the text.  That of a reference return is told by a rule of its own.
  const Word *codeBefore(NodeId node) const {
    const FileContext &context = view_.context();
    const BlockId first = context.model.programs[view_.program()].first;
    for (BlockId block = view_.node(node).block;; block = BlockId(block.index() - 1)) {
      if (const Word *code = findAction(context.tree, block, context.dialect, {CodeAction::Incremental}))
        return findCode(context.tree, block, context.dialect, CodeRole::ReferenceReturn) ? nullptr : code;
      if (block == first)
        return nullptr;
    }
  }

  MotionView view_;
  std::set<NodeId> zero_;
  std::set<NodeId> other_; // in some other state
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<IncrementalMoveOfZero>(program, context);
}

} // namespace

extern const Rule incrementalMoveOfZero;
const Rule incrementalMoveOfZero{.info = {"incremental-move-of-zero", Category::Motion, Severity::Warning,
                                          "Reports a rapid move to `X0 Y0` while `G91` is active: it moves nothing."},
                                 .hooks = {.watch = watch}};

} // namespace feedhold::rules::incremental_move_of_zero
