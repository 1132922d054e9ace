// case-to-wrong-block: `IF[#1EQ1]GOTO10`, `IF[#1EQ2]GOTO20`, `IF[#1EQ3]GOTO40`, and no jump to N30.
#include "rules/flow/case_ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feedhold::rules::case_to_wrong_block {
namespace {

struct Point {
  double value;
  double target;
};

/// The number that the other lines of the list lead one to expect: their targets are in step with their values.
std::optional<double> expected(const CaseLadder &ladder, std::size_t odd) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < ladder.cases.size(); ++i) {
    const CaseLine &line = ladder.cases[i];
    if (!line.jump || !line.jump->number)
      return std::nullopt;
    if (i != odd)
      points.push_back({line.value.toDouble(), line.jump->number->toDouble()});
  }
  if (points.size() < 2 || points[0].value == points[1].value)
    return std::nullopt;
  const double step = (points[1].target - points[0].target) / (points[1].value - points[0].value);
  const auto at = [&](double value) { return points[0].target + step * (value - points[0].value); };
  if (step == 0 || std::ranges::any_of(points, [&](const Point &point) { return at(point.value) != point.target; }))
    return std::nullopt;
  return at(ladder.cases[odd].value.toDouble());
}

/// The block with the sequence number that no run comes to: no jump of the program names it, and the block before
/// leaves.
const SequenceNumber *unusedLabel(const FileContext &context, ProgramId program, double number) {
  const auto labels = context.model.sequenceNumbersOf(program);
  const auto label = std::ranges::find(labels, number, &SequenceNumber::number);
  const auto jumps = context.model.jumpsOf(program);
  const bool isUsed =
      std::ranges::any_of(jumps, [&](const Jump &jump) { return !jump.number || jump.number->toDouble() == number; });
  if (label == labels.end() || isUsed || label->block == context.model.programs[program].first)
    return nullptr;
  // What is in front of it runs into it, and it is a number among others.
  const FlowAfter before = flowAfter(context.tree, BlockId(label->block.index() - 1), context.dialect);
  return before == FlowAfter::Next || before == FlowAfter::MayJump ? nullptr : &*label;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  for (const CaseLadder &ladder : caseLaddersOf(context, program))
    for (std::size_t i = 0; i < ladder.cases.size(); ++i) {
      const auto number = expected(ladder, i);
      const Jump *jump = ladder.cases[i].jump;
      if (!number || !jump->target || jump->number->toDouble() == *number)
        continue;
      const SequenceNumber *label = unusedLabel(context, program, *number);
      if (!label)
        continue;
      reporter.report({.message = fmt::format("{} breaks the row of this list: `N{}` would continue it, and no jump "
                                              "leads there",
                                              context.quoted(jump->span), *number),
                       .span = jump->span,
                       .labels = {{context.tree.words[label->word].span(), "no jump leads here"}},
                       .notes = {"for this value the program executes the blocks of another case",
                                 "correct the number of the GOTO"}});
      break;
    }
}

} // namespace

extern const Rule caseToWrongBlock;
const Rule caseToWrongBlock{
    .info = {"case-to-wrong-block", Category::Flow, Severity::Warning,
             "Reports a list of `IF[..EQ..]GOTO` of which one line leaves out the block that would be its turn."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::case_to_wrong_block
