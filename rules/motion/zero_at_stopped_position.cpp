// zero-at-stopped-position: `G38.2 Z-50 F200`, then `G92 Z0`: where the axis has come to rest, not where the probe
// tripped.
#include "findings/rule/rule.h"

#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

namespace feedhold::rules::zero_at_stopped_position {
namespace {

constexpr std::string_view kAxes = "XYZ";

/// The axis of a probing move of one axis.
std::optional<char> probedAxis(BlockId block, const FileContext &context) {
  const Word *probe = nullptr;
  for (const Word &word : context.tree.wordsOf(block))
    if (const Code *code = codeOf(word, context.dialect); code && isSkip(code->role))
      probe = &word;
  std::optional<char> axis;
  for (const char letter : kAxes)
    if (probe && findWord(context.tree, block, letter)) {
      if (axis)
        return std::nullopt;
      axis = letter;
    }
  return axis;
}

bool namesAxis(BlockId block, const FileContext &context) {
  for (const char letter : kAxes)
    if (findWord(context.tree, block, letter))
      return true;
  return false;
}

/// `G92 Z0`, `G10 L20 P1 Z0`: what makes the place of the axis a coordinate.
const Word *setterIn(BlockId block, const FileContext &context) {
  if (const Word *set = findAction(context.tree, block, context.dialect, {CodeAction::CoordinateSet}))
    return set;
  const Word *code = findCode(context.tree, block, context.dialect, CodeRole::DataSetting);
  const Word *kind = findWord(context.tree, block, 'L');
  return code && kind && kind->integer() == 20 ? code : nullptr;
}

void tell(const Word &coordinate, BlockId probe, char axis, const FileContext &context, const Reporter &reporter) {
  const std::string place = context.dialect.grammar.namedParameters
                                ? fmt::format("[#<_{}>-#{}]", static_cast<char>(axis - 'A' + 'a'), 5061 + (axis - 'X'))
                                : fmt::format("[#{}-#{}]", 5041 + (axis - 'X'), 5061 + (axis - 'X'));
  reporter.report({.message = fmt::format("{} is set where the axis has stopped, not where the probe tripped",
                                          context.quoted(coordinate.span())),
                   .span = coordinate.span(),
                   .labels = {{context.tree.blocks[probe].span(), "the axis slows down behind the trip point"}},
                   .notes = {"the zero is wrong by the stopping distance, which grows with the square of the feed",
                             fmt::format("add it: `{}{}`, plus the thickness of a plate", axis, place)}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const Program &its = context.model.programs[program];
  std::optional<BlockId> probe;
  const auto targets = context.model.jumpTargetsOf(program);
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    if (context.tree.blocks[block].has(Block::kBroken) || targets.contains(block))
      probe = std::nullopt;
    if (const auto axis = probedAxis(block, context); axis || setterIn(block, context)) {
      const Word *coordinate = !axis && probe ? findWord(context.tree, block, *probedAxis(*probe, context)) : nullptr;
      if (coordinate && coordinate->isNumber())
        tell(*coordinate, *probe, coordinate->address(), context, reporter);
      probe = axis ? std::optional(block) : std::nullopt;
    } else if (namesAxis(block, context) || !context.model.callsIn(block, block.next()).empty()) {
      probe = std::nullopt;
    }
  }
}

} // namespace

extern const Rule zeroAtStoppedPosition;
const Rule zeroAtStoppedPosition{
    .info = {"zero-at-stopped-position", Category::Motion, Severity::Warning,
             "Reports a zero that is set directly behind a probing move without the distance on which the axis stops."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::zero_at_stopped_position
