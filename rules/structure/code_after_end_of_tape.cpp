// code-after-end-of-tape: blocks behind the closing `%`.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::code_after_end_of_tape {
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

/// The blocks of a file that hold more than comments.
struct Shares {
  std::size_t read = 0;
  std::size_t behind = 0;
  std::optional<BlockId> firstBehind;
};

Shares sharesOf(const FileContext &context) {
  Shares shares;
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i) {
    const Block &block = context.tree.blocks[BlockId(i)];
    if (block.has(Block::kPercent) || block.has(Block::kLeader) || !hasContent(context, BlockId(i)))
      continue;
    if (!block.has(Block::kAfterEnd)) {
      ++shares.read;
      continue;
    }
    ++shares.behind;
    if (!shares.firstBehind)
      shares.firstBehind = BlockId(i);
  }
  return shares;
}

void reportJumps(const std::vector<const Jump *> &jumps, Span span, const FileContext &context,
                 const Reporter &reporter) {
  Diagnostic diagnostic{.message = "the program jumps to blocks after the closing `%`",
                        .span = span,
                        .label = "the control does not read this",
                        .notes = {fmt::format("blocks after the `%` are not stored: at the jump the control {}",
                                              stopsWith(context.dialect, AlarmKind::SequenceNotFound)),
                                  "move the `%` to the end of the file"}};
  for (std::size_t i = 0; i < jumps.size() && i < kShownJumps; ++i)
    diagnostic.labels.push_back(
        {jumps[i]->span, fmt::format("`N{}` is after the closing `%`", *targetNumber(*jumps[i]))});
  if (jumps.size() > kShownJumps)
    diagnostic.notes.push_back(fmt::format("{} more jumps lead to blocks after the `%`", jumps.size() - kShownJumps));
  reporter.report(std::move(diagnostic));
}

/// The `%` with which the tape ends: of two, so that what stands behind it is no tape of its own.  Blocks from an O
/// word on have no Block::kAfterEnd, since they may be one.
std::optional<BlockId> endOfTape(const FileContext &context) {
  std::vector<BlockId> percents;
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i)
    if (context.tree.blocks[BlockId(i)].has(Block::kPercent))
      percents.push_back(BlockId(i));
  return percents.size() == 2 ? std::optional(percents.back()) : std::nullopt;
}

/// A program calls one that stands behind it: text between two `%` of its own would be another file.
void checkCalls(const FileContext &context, const Reporter &reporter) {
  const auto end = endOfTape(context);
  if (!end)
    return;
  for (const Call &call : context.model.callsIn(BlockId(0), *end)) {
    const auto callee = context.callGraph.callee(context.file, call);
    if (!callee || callee->file != context.file || context.model.programs[callee->program].first < *end)
      continue;
    const std::string name = toString(context.model.programs[callee->program].name);
    return reporter.report(
        {.message = fmt::format("{} calls {}, which stands after the closing `%`", context.quoted(call.span), name),
         .span = call.span,
         .labels = {{context.tree.blocks[*end].span(), "the control reads no further"},
                    {context.model.programs[callee->program].header, "not stored"}},
         .notes = {fmt::format("at the call the control {}", stopsWith(context.dialect, AlarmKind::ProgramNotFound)),
                   "move the `%` to the end of the file"}},
        Severity::Warning);
  }
}

void check(const FileContext &context, const Reporter &reporter) {
  checkCalls(context, reporter);
  const Shares shares = sharesOf(context);
  if (!shares.firstBehind)
    return;
  const Span span = context.tree.blocks[*shares.firstBehind].span();
  const auto jumps = lostJumps(context);
  if (!jumps.empty())
    return reportJumps(jumps, span, context, reporter);
  constexpr auto *kWayOut = "these blocks are not stored in the control; delete them, or move the `%` to the end of "
                            "the file";
  if (shares.behind <= shares.read)
    return reporter.report(
        {.message = "the control does not read text after the closing `%`", .span = span, .notes = {kWayOut}},
        Severity::Info);
  reporter.report(
      {.message = "most of the file stands after the closing `%` and is not read",
       .span = span,
       .notes = {fmt::format("blocks before the `%`: {}, after it: {}", shares.read, shares.behind), kWayOut}},
      Severity::Warning);
}

} // namespace

extern const Rule codeAfterEndOfTape;
const Rule codeAfterEndOfTape{
    .info = {"code-after-end-of-tape", Category::Structure, Severity::Error,
             "Reports program text after the closing `%`; it is an error when the program jumps there, and a warning "
             "when it calls a program there, or most of the file stands there."},
    .hooks = {.file = check}};

} // namespace feedhold::rules::code_after_end_of_tape
