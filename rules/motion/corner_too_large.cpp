// corner-too-large: `X2. ,C3.` from X0, or a next line that is too short.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::corner_too_large {
namespace {

/// The control stops at the second line; the corner stands in the block of the first one.
class CornerTooLarge final : public FlowRule {
public:
  CornerTooLarge(ProgramId program, const FileContext &context) : view_(program, context) {}

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    std::map<NodeId, AlarmKind> stops; // at the second line; the first alarm is the one that comes
    for (const AlarmFact &alarm : facts.alarms())
      if (alarm.always &&
          (alarm.kind == AlarmKind::CornerTooLarge || alarm.kind == AlarmKind::LineBehindCornerTooShort))
        stops.emplace(alarm.node, alarm.kind);
    for (const auto &[line, kind] : stops)
      if (const auto first = firstLine(line))
        tell(facts, *first, line, kind, context, reporter);
  }

private:
  void tell(const FlowFacts &facts, NodeId first, NodeId second, AlarmKind kind, const FileContext &context,
            const Reporter &reporter) const {
    const Word *corner = cornerIn(first);
    const bool isFirst = kind == AlarmKind::CornerTooLarge;
    reporter.report({.message = fmt::format("{} takes more of the line {} it than that is long",
                                            context.quoted(corner->span()), isFirst ? "before" : "behind"),
                     .span = corner->span(),
                     .labels = {{view_.blockSpan(isFirst ? first : second), "this line"}},
                     .flow = pathFromEntry(facts, first),
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, kind)),
                               "correct the corner, or the ends of the two lines"}});
  }
  /// The block with the corner is the one before, but for nodes without words.
  std::optional<NodeId> firstLine(NodeId second) const {
    const NodeId entry = view_.cfg().entryOf(view_.program());
    for (NodeId node = second; node > entry;) {
      node = NodeId(node.index() - 1);
      if (cornerIn(node))
        return node;
      if (!view_.wordsOf(node).empty())
        return std::nullopt;
    }
    return std::nullopt;
  }
  const Word *cornerIn(NodeId node) const {
    for (const Word *word : view_.wordsOf(node))
      if (word->has(Word::kComma) && (word->address() == 'C' || word->address() == 'R'))
        return word;
    return nullptr;
  }

  MotionView view_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CornerTooLarge>(program, context);
}

} // namespace

extern const Rule cornerTooLarge;
const Rule cornerTooLarge{.info = {"corner-too-large", Category::Motion, Severity::Error,
                                   "Reports `,C` or `,R` that needs more than one of its two sides is long."},
                          .hooks = {.watch = watch}};

} // namespace feedhold::rules::corner_too_large
