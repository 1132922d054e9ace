// code-after-end-of-tape: blocks behind the closing `%`.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

constexpr std::size_t kShownJumps = 3;

/// The jumps that look for a block behind the end.
std::vector<const Jump *> lostJumps(const FileContext &context) {
  std::vector<const Jump *> jumps;
  for (const Jump &jump : context.model.jumps) {
    const auto number = targetNumber(jump);
    if (number && !jump.target && context.model.isBehindEnd(*number))
      jumps.push_back(&jump);
  }
  return jumps;
}

std::optional<BlockId> firstBlockBehind(const FileContext &context) {
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i)
    if (context.tree.blocks[BlockId(i)].has(Block::kAfterEnd) && hasContent(context, BlockId(i)))
      return BlockId(i);
  return std::nullopt;
}

void reportJumps(const std::vector<const Jump *> &jumps, Span span, const FileContext &context,
                 const Reporter &reporter) {
  Diagnostic diagnostic{.message = "the program jumps to blocks behind the closing `%`",
                        .span = span,
                        .label = "not read by the control",
                        .notes = {fmt::format("the blocks are not stored with the program: at the jump the control {}",
                                              stopsWith(context.dialect, AlarmKind::SequenceNotFound)),
                                  "move the `%` to the end of the file"}};
  for (std::size_t i = 0; i < jumps.size() && i < kShownJumps; ++i)
    diagnostic.labels.push_back({jumps[i]->span, fmt::format("`N{}` is behind the end", *targetNumber(*jumps[i]))});
  if (jumps.size() > kShownJumps)
    diagnostic.notes.push_back(fmt::format("{} more jumps go there", jumps.size() - kShownJumps));
  reporter.report(std::move(diagnostic));
}

void check(const FileContext &context, const Reporter &reporter) {
  const auto first = firstBlockBehind(context);
  if (!first)
    return;
  const Span span = context.tree.blocks[*first].span();
  const auto jumps = lostJumps(context);
  if (!jumps.empty())
    return reportJumps(jumps, span, context, reporter);
  reporter.report({.message = "text behind the closing `%` is not read by the control",
                   .span = span,
                   .notes = {"what stands here is not stored with the program"}},
                  Severity::Info);
}

} // namespace

extern const Rule codeAfterEndOfTape;
const Rule codeAfterEndOfTape{
    .info = {"code-after-end-of-tape", Category::Structure, Severity::Error,
             "Reports program text behind the closing `%`; an error when the program jumps there."},
    .hooks = {.file = check}};

} // namespace feedhold::rules
