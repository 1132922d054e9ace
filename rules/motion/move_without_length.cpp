// move-without-length: `G49`, and in a later block `G00 Z#18`.
#include "rules/flow/flow_view.h"
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::move_without_length {
namespace {

class MoveWithoutLength final : public FlowRule {
public:
  MoveWithoutLength(ProgramId program, const FileContext &context) : view_(program, context) {}

  void before(NodeId node, const AbstractState &state) override {
    if (view_.mayHave(node, 'Z'))
      hadLength_ = !isHavocked(state) &&
                   view_.wasSet(state, ModalKind::Length, {CodeAction::LengthPlus, CodeAction::LengthMinus}) &&
                   view_.surely(state, ModalKind::Length, {CodeAction::LengthPlus, CodeAction::LengthMinus});
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!view_.mayHave(node, 'Z') || isHavocked(state) || !zWord(node) ||
        view_.findAction(node, {CodeAction::ToolChange}))
      return;
    if (view_.sets(node, ModalKind::Length))
      return noteOff(node, state);
    if (view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}) &&
        view_.surely(state, ModalKind::Length, {CodeAction::LengthOff}) &&
        view_.wasSet(state, ModalKind::Length, {CodeAction::LengthOff}))
      moves_.push_back(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    // Hobby machines have G49 in each preamble, and tools without lengths.
    if (context.dialect.behaviour.endRestoresModes)
      return;
    for (const NodeId node : offs_)
      tellOff(node, context, reporter);
    if (moves_.empty() || (!usesLengthOffset(facts) && !isCalled(facts, context)))
      return;
    std::ranges::sort(moves_);
    for (NodeId off = facts.entry(); off < facts.end(); off = off.next())
      if (facts.isReached(off) && view_.findAction(off, {CodeAction::LengthOff}))
        tell(off, facts, context, reporter);
  }

private:
  /// `G49 Z100.` while a length is in force: the block moves to its Z without it.
  void noteOff(NodeId node, const AbstractState &state) {
    if (view_.findAction(node, {CodeAction::LengthOff}) &&
        view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}) && hadLength_ && isNear(node, state))
      offs_.insert(node);
  }
  /// Nearer to the part than most tools are long: a height far above it keeps them clear, too.
  bool isNear(NodeId node, const AbstractState &state) const {
    constexpr double kLong = 150; // mm
    const Word &word = *zWord(node);
    const double unit = view_.wasSet(state, ModalKind::Units, {CodeAction::Inch}) ? 25.4 : 1;
    return word.isNumber() && word.number().toDouble() * unit < kLong;
  }
  const Word *zWord(NodeId node) const {
    for (const Word *word : view_.modalMotionWords(node))
      if (word->address() == 'Z')
        return word;
    return nullptr;
  }
  /// A macro works with the tool, and the length offset, of its caller.
  static bool isCalled(const FlowFacts &facts, const FileContext &context) {
    return context.model.programs[facts.program].returns && !isMainProgram(facts);
  }
  bool usesLengthOffset(const FlowFacts &facts) const {
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      if (facts.isReached(node) && view_.findAction(node, {CodeAction::LengthPlus, CodeAction::LengthMinus}))
        return true;
    return false;
  }
  void tellOff(NodeId node, const FileContext &context, const Reporter &reporter) const {
    reporter.report(
        {.message = fmt::format("{} moves the tool without its length", context.quoted(zWord(node)->span())),
         .span = zWord(node)->span(),
         .labels = {{view_.findAction(node, {CodeAction::LengthOff})->span(), "the length offset ends in this block"}},
         .notes = {"the spindle nose goes to this height, and the tool is below it by its length",
                   "retract before `G49`, or by `G53` or `G28`; approach with `G43` and H"}});
  }
  void tell(NodeId off, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
    const auto isOver = [&](NodeId node) {
      return (node != off && view_.sets(node, ModalKind::Length)) || view_.findAction(node, {CodeAction::ToolChange});
    };
    const auto node = firstReached(facts, off, moves_, isOver);
    if (!node || told_ == node)
      return;
    told_ = node;
    reporter.report(
        {.message = fmt::format("{} moves the tool without its length", context.quoted(zWord(*node)->span())),
         .span = zWord(*node)->span(),
         .labels = {{view_.findAction(off, {CodeAction::LengthOff})->span(), "the length offset ends here"}},
         .notes = {"the spindle nose goes to this height, and the tool is below it by its length",
                   "retract before `G49`, or by `G53` or `G28`; approach with `G43` and H"}});
  }

  MotionView view_;
  std::vector<NodeId> moves_;
  std::optional<NodeId> told_;
  bool hadLength_ = false; // before the node
  std::set<NodeId> offs_;  // G49 beside a Z
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<MoveWithoutLength>(program, context);
}

} // namespace

extern const Rule moveWithoutLength;
const Rule moveWithoutLength{.info = {"move-without-length", Category::Motion, Severity::Warning,
                                      "Reports a move in `Z` behind `G49`, in a program that sets a length offset."},
                             .hooks = {.watch = watch}};

} // namespace feedhold::rules::move_without_length
