// approach-before-length-offset: a Z behind M06 and before G43.
#include "rules/flow/loop_view.h"
#include "rules/motion/folder_programs.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::approach_before_length_offset {
namespace {

constexpr std::initializer_list<CodeAction> kOffsets = {CodeAction::LengthPlus, CodeAction::LengthMinus,
                                                        CodeAction::Unmodelled};

/// Behind how many tool changes of a folder the first block with a Z is the one with G43, and behind how many not.
struct Approaches {
  int withOffset = 0;
  int before = 0;
};

void count(const ProgramFile &file, const FileContext &context, Approaches &approaches) {
  const FileContext here = contextOf(file, context);
  bool isNew = false; // the tool
  for (std::size_t i = 0; i < file.tree->blockCount(); ++i) {
    const BlockId block(i);
    const auto has = [&](std::initializer_list<CodeAction> actions) {
      return findAction(*file.tree, block, *file.dialect, actions) != nullptr;
    };
    const auto words = here.tree.wordsOf(block);
    const bool changes = has({CodeAction::ToolChange});
    isNew = isNew || changes;
    if (!isNew)
      continue;
    if (has(kOffsets)) {
      approaches.withOffset += 1;
      isNew = false;
    } else if (!changes && !has({CodeAction::MachineMove, CodeAction::Incremental, CodeAction::ReferenceReturn}) &&
               std::ranges::any_of(words, [](const Word &word) { return word.address() == 'Z'; })) {
      approaches.before += 1;
      isNew = false;
    }
  }
}

/// What a shop does in all its programs is no slip: its tools are long enough for it, or set some other way.
bool isHabit(const FileContext &context) {
  constexpr int kHabit = 3;
  Approaches approaches;
  for (const FileId file : filesOfFolder(context))
    count(context.programs->file(file), context, approaches);
  return approaches.before >= kHabit && approaches.withOffset == 0;
}

class ApproachBeforeLengthOffset final : public FlowRule {
public:
  ApproachBeforeLengthOffset(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (view_.mayHave(node, 'Z') && !isHavocked(state) && zWord(node) && !isBehind(node) &&
        view_.surely(state, ModalKind::Distance, {CodeAction::Absolute})) {
      approaches_.push_back(node);
      if (view_.inForce(state, ModalKind::Length) == CodeSet::atEntry())
        withLengthOfEntry_.insert(node);
    }
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    if (!usesLengthOffset(facts))
      return;
    std::ranges::sort(approaches_);
    for (NodeId change = facts.entry(); change < facts.end(); change = change.next())
      if (facts.isReached(change) && view_.findAction(change, {CodeAction::ToolChange}) &&
          !view_.findAction(change, kOffsets)) // `T5 M6 G43`
        tell(change, facts, context, reporter);
    for (const NodeId node : withLengthOfEntry_)
      if (comesBeforeOffset(node, facts)) {
        tellBeforeFirst(node, reporter, context);
        return;
      }
  }

private:
  /// The next block sets the length of a tool that was changed before the program, or by hand.
  bool comesBeforeOffset(NodeId node, const FlowFacts &facts) const {
    const NodeId next = view_.node(node).next;
    if (next == node || !view_.findAction(next, {CodeAction::LengthPlus, CodeAction::LengthMinus}) || !zWord(next))
      return false;
    for (NodeId other = facts.entry(); other < node; other = other.next())
      if (view_.findAction(other, {CodeAction::ToolChange}))
        return false;
    return true;
  }
  void tellBeforeFirst(NodeId node, const Reporter &reporter, const FileContext &context) const {
    reporter.report({.message = fmt::format("{} moves the tool before its `G43`", context.quoted(zWord(node)->span())),
                     .span = zWord(node)->span(),
                     .labels = {{view_.blockSpan(view_.node(node).next), "sets the length offset"}},
                     .notes = {"the length offset is that of the program before, or none: the tool may hit the part",
                               "write G43 and H in the first block that moves Z"}});
  }
  const Word *zWord(NodeId node) const {
    for (const Word *word : view_.modalMotionWords(node))
      if (word->address() == 'Z')
        return word;
    return nullptr;
  }
  /// Shops that measure their tools into the work offset have no G43 anywhere.
  bool usesLengthOffset(const FlowFacts &facts) const {
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      if (facts.isReached(node) && view_.findAction(node, {CodeAction::LengthPlus, CodeAction::LengthMinus}))
        return true;
    return false;
  }
  /// Behind them the offset is in force, or may be.
  bool isBehind(NodeId node) const {
    return view_.findAction(node, kOffsets) != nullptr || view_.findAction(node, {CodeAction::ToolChange}) != nullptr ||
           std::holds_alternative<CallProgram>(view_.node(node).instruction);
  }
  void tell(NodeId change, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) const {
    const auto isOver = [&](NodeId other) { return isBehind(other); };
    const auto sets = [&](NodeId other) { return view_.findAction(other, kOffsets) != nullptr; };
    const auto node = firstReached(facts, change, approaches_, isOver);
    if (!node || !reachesPastLoops(facts, change, *node, sets, isOver))
      return;
    reporter.report(
        {.message = fmt::format("{} moves the new tool before its `G43`", context.quoted(zWord(*node)->span())),
         .span = zWord(*node)->span(),
         .labels = {{view_.findAction(change, {CodeAction::ToolChange})->span(), "tool change"}},
         .flow = describePath(facts, *findPath(facts, change, *node, isOver)),
         .notes = {"the length offset is that of the previous tool, or none: the new tool may hit the part",
                   "write G43 and H in the first block that moves Z"}},
        isHabit(context) ? Severity::Info : Severity::Warning);
  }

  MotionView view_;
  std::vector<NodeId> approaches_;     // with a Z, and no offset in the same block
  std::set<NodeId> withLengthOfEntry_; // of these, those before any G43 and G49 of the program
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ApproachBeforeLengthOffset>(program, context);
}

} // namespace

extern const Rule approachBeforeLengthOffset;
const Rule approachBeforeLengthOffset{
    .info = {"approach-before-length-offset", Category::Motion, Severity::Warning,
             "Reports a move in `Z` between a tool change and the `G43` of the new tool."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::approach_before_length_offset
