// output-without-motion: `M62 P2`, and `M66 P2 L3 Q5` in the next block.
#include "rules/motion/queued_output.h"

#include <fmt/format.h>

namespace feedhold::rules::output_without_motion {
namespace {

/// Straight down from the output: the M66 of the next block that does something.
const Word *waitBehind(NodeId output, const FlowFacts &facts, const FileContext &context) {
  NodeId node = facts.node(output).next;
  while (node < facts.end() && std::holds_alternative<Pass>(facts.node(node).instruction) &&
         facts.node(node).next != node)
    node = facts.node(node).next;
  if (!(node < facts.end()) || !std::holds_alternative<ExecuteWords>(facts.node(node).instruction))
    return nullptr;
  return waitIn(facts.node(node).block, context);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.grammar.oWords)
    return;
  const MotionView view(facts.program, context);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    if (!facts.isReached(node) || !std::holds_alternative<ExecuteWords>(facts.node(node).instruction) ||
        !view.axisWords(node).empty())
      continue;
    const BlockId block = facts.node(node).block;
    const auto output = outputIn(block, context);
    const Word *wait = output && output->isQueued ? waitBehind(node, facts, context) : nullptr;
    if (!wait)
      continue;
    const Span span{output->code->span().begin, output->pin->span().end};
    const std::string_view now = output->isOn ? "M64" : "M65";
    reporter.report(
        {.message = fmt::format("{} switches with the next motion, and {} waits before it",
                                context.quoted(output->code->span()), context.quoted(wait->span())),
         .span = output->code->span().end < span.end ? span : output->code->span(),
         .labels = {{wait->span(), "waits here"}},
         .notes = {"the output has not changed yet, so that the input for which the program waits does not "
                   "come",
                   fmt::format("write `{}`, which switches at once", now)},
         .fixes = {{.title = fmt::format("write `{}`", now), .edits = {{output->code->span(), std::string(now)}}}}});
  }
}

} // namespace

extern const Rule outputWithoutMotion;
const Rule outputWithoutMotion{.info = {"output-without-motion", Category::Motion, Severity::Warning,
                                        "Reports an output that switches with the next motion, where the program waits "
                                        "for an input before it."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::output_without_motion
