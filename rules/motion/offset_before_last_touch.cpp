// offset-before-last-touch: `G10 L2 P1 X#5061`, and the touch in Y that may still miss comes behind it.
#include "rules/flow/definitions.h"
#include "rules/flow/system_variables.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::offset_before_last_touch {
namespace {

/// `G10 L2 P1 X#5061`
struct OffsetBlock {
  NodeId node;
  std::string_view kind;   // of L
  std::string_view number; // of P
};

class Reader {
public:
  Reader(const FlowFacts &facts, const FileContext &context)
      : facts_(facts), context_(context), view_(facts.program, context) {
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
      if (!facts.isReached(node))
        continue;
      if (const auto offset = offsetAt(node))
        offsets_.push_back(*offset);
      if (isUnsureSkip(node))
        skips_.push_back(node);
      if (isCheck(node))
        checks_.push_back(node);
    }
  }

  void report(const Reporter &reporter) const {
    for (std::size_t i = 0; i < offsets_.size(); ++i)
      for (std::size_t later = i + 1; later < offsets_.size(); ++later)
        if (isSameOffset(offsets_[i], offsets_[later]))
          if (const auto skip = touchBetween(offsets_[i].node, offsets_[later].node))
            return tell(offsets_[i], *skip, offsets_[later], reporter);
  }

private:
  std::optional<OffsetBlock> offsetAt(NodeId node) const {
    if (!findCode(context_.tree, facts_.node(node).block, context_.dialect, CodeRole::DataSetting))
      return std::nullopt;
    OffsetBlock offset{node, {}, {}};
    bool isMeasured = false;
    for (const Word *word : view_.wordsOf(node)) {
      if (word->address() == 'L')
        offset.kind = context_.text(word->span());
      else if (word->address() == 'P')
        offset.number = context_.text(word->span());
      else if (word->form() == WordForm::Expression)
        isMeasured = isMeasured || readsTouch(word->expression(), node, 0);
    }
    return isMeasured && !offset.kind.empty() ? std::optional(offset) : std::nullopt;
  }
  /// `#5061`, or what has been computed from it.
  bool readsTouch(ExpressionId expression, NodeId node, int depth) const {
    constexpr int kDeepest = 4;
    const auto reads = readsIn(facts_.file, expression, facts_.node(node).block);
    return std::ranges::any_of(reads, [&](const Read &read) {
      const auto variable = variableOf(facts_, read.expression);
      if (!variable || roleOf(context_, *variable) == VariableRole::SkipPosition || depth == kDeepest)
        return variable && roleOf(context_, *variable) == VariableRole::SkipPosition;
      const auto known = definitionsOf(facts_, *variable, node);
      const auto assignment = known && !known->fromEntry && known->nodes.size() == 1
                                  ? assignmentTo(facts_, known->nodes.front(), *variable)
                                  : std::nullopt;
      return assignment && readsTouch(assignment->value, known->nodes.front(), depth + 1);
    });
  }
  bool isUnsureSkip(NodeId node) const {
    return view_.mayDo(node, {CodeAction::Skip}) &&
           findCode(context_.tree, facts_.node(node).block, context_.dialect, CodeRole::Skip);
  }
  /// Asks where a touch was, and leads to an alarm.
  bool isCheck(NodeId node) const {
    const auto *test = std::get_if<Test>(&facts_.node(node).instruction);
    return test && test->condition && alarmWhenTrue(facts_, node) && readsTouch(*test->condition, node, 0);
  }
  bool isSameOffset(const OffsetBlock &left, const OffsetBlock &right) const {
    return left.kind == right.kind && left.number == right.number;
  }
  bool leads(NodeId from, NodeId to) const {
    return from < to && findPath(facts_, from, to, [](NodeId) { return false; });
  }
  /// A touch behind the first block that a check in front of the second one may refuse.
  std::optional<NodeId> touchBetween(NodeId first, NodeId second) const {
    for (const NodeId skip : skips_)
      if (leads(first, skip) && leads(skip, second) && !findPath(facts_, skip, first, [](NodeId) { return false; }) &&
          std::ranges::any_of(checks_, [&](NodeId check) { return leads(skip, check) && leads(check, second); }))
        return skip;
    return std::nullopt;
  }

  void tell(const OffsetBlock &first, NodeId skip, const OffsetBlock &second, const Reporter &reporter) const {
    reporter.report(
        {.message = fmt::format("{} sets the offset before the last touch is checked",
                                context_.quoted(view_.blockSpan(first.node))),
         .span = view_.blockSpan(first.node),
         .labels = {{view_.blockSpan(skip), "this touch may still miss"},
                    {view_.blockSpan(second.node), "sets the other axis"}},
         .notes = {"if the later touch misses, the alarm leaves an offset with one new axis and one old axis",
                   "keep the measured values in variables, and set the offset behind the last check"}});
  }

  const FlowFacts &facts_;
  const FileContext &context_;
  MotionView view_;
  std::vector<OffsetBlock> offsets_;
  std::vector<NodeId> skips_;
  std::vector<NodeId> checks_;
};

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!isTooLarge(facts))
    Reader(facts, context).report(reporter);
}

} // namespace

extern const Rule offsetBeforeLastTouch;
const Rule offsetBeforeLastTouch{.info = {"offset-before-last-touch", Category::Motion, Severity::Info,
                                          "Reports an offset that is set from one touch before a later touch for the "
                                          "same offset is checked."},
                                 .hooks = {.flow = check}};

} // namespace feedhold::rules::offset_before_last_touch
