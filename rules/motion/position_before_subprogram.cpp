// position-before-subprogram: `G00 X30. Y10.`, `M98 P2001`, and O2001 begins with `G83 X0 Y0`.
#include "findings/rule/rule.h"

#include "findings/rule/dead_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

namespace feedhold::rules::position_before_subprogram {
namespace {

/// A block with X and Y as numbers.
struct Position {
  const Word *x;
  const Word *y;
  Span span;
};

const Word *numberIn(const FileContext &context, BlockId block, char address) {
  const Word *word = findWord(context.tree, block, address);
  return word && word->isNumber() ? word : nullptr;
}

/// Codes behind which X0 is somewhere else, or the work is another one.
bool changesWork(const FileContext &context, BlockId block) {
  return findWord(context.tree, block, 'T') || findWord(context.tree, block, 'B') ||
         findWord(context.tree, block, 'A') || findWord(context.tree, block, 'C') ||
         findCode(context.tree, block, context.dialect, CodeRole::DataSetting) ||
         findCode(context.tree, block, context.dialect, CodeRole::ReferenceReturn) ||
         !context.tree.statementsOf(block).empty() ||
         findAction(context.tree, block, context.dialect,
                    {CodeAction::Incremental, CodeAction::WorkOffset, CodeAction::ExtendedWorkOffset,
                     CodeAction::LocalShift, CodeAction::CoordinateSet, CodeAction::MachineMove, CodeAction::ToolChange,
                     CodeAction::MirrorOn, CodeAction::RotationOn, CodeAction::ScalingOn, CodeAction::Unmodelled,
                     CodeAction::Anything, CodeAction::PolarOn});
}

/// The first movement of a called program in X or Y, where it goes to a position of its own.
std::optional<Position> startOf(const FileContext &context, const ProgramRef &callee) {
  if (callee.file != context.file)
    return std::nullopt;
  const Program &its = context.model.programs[callee.program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    const bool isChange = findAction(context.tree, block, context.dialect, {CodeAction::ToolChange}) != nullptr;
    if ((!isChange && changesWork(context, block)) || !context.model.callsIn(block, block.next()).empty())
      return std::nullopt;
    if (!findWord(context.tree, block, 'X') && !findWord(context.tree, block, 'Y'))
      continue;
    const Word *x = numberIn(context, block, 'X');
    const Word *y = numberIn(context, block, 'Y');
    return x && y && !meansOwnWords(context.tree, block, context.dialect)
               ? std::optional(Position{x, y, context.tree.blocks[block].span()})
               : std::nullopt;
  }
  return std::nullopt;
}

/// The block directly before a call, with X and Y and nothing else that moves.
std::optional<Position> before(const FileContext &context, BlockId call, BlockId first) {
  for (BlockId block = call; block > first;) {
    block = BlockId(block.index() - 1);
    if (!hasContent(context, block))
      continue;
    const Word *x = numberIn(context, block, 'X');
    const Word *y = numberIn(context, block, 'Y');
    if (!x || !y || findWord(context.tree, block, 'Z') || meansOwnWords(context.tree, block, context.dialect))
      return std::nullopt;
    return Position{x, y, context.tree.blocks[block].span()};
  }
  return std::nullopt;
}

/// Nothing between two calls makes the second one other work than the first.
bool isSameWork(const FileContext &context, BlockId first, BlockId second) {
  for (BlockId block = first.next(); block < second; block = block.next())
    if (changesWork(context, block) || findWord(context.tree, block, 'Z') ||
        !context.model.callsIn(block, block.next()).empty() || context.tree.blocks[block].has(Block::kSkip))
      return false;
  return true;
}

struct Visit {
  Position position;
  BlockId call;
};

void tell(const Visit &one, const Visit &two, const Position &start, const ProgramName &name,
          const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("{} has no effect: {} goes to {} {} first", context.quoted(two.position.span),
                              toString(name), context.quoted(start.x->span()), context.quoted(start.y->span())),
       .span = two.position.span,
       .labels = {{one.position.span, "nor has this"}, {start.span, "the same for every call"}},
       .notes = {"each call works at the same place",
                 fmt::format("take X and Y out of this block of {}, or write it in G91", toString(name))}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling || context.dialect.grammar.oWords)
    return;
  std::map<ProgramId, std::vector<Visit>> visits;
  for (const Call &call : context.model.callsOf(program)) {
    const auto callee = call.kind == CallKind::Subprogram ? context.callGraph.callee(context.file, call) : std::nullopt;
    if (!callee || callee->file != context.file || callee->program == program)
      continue;
    auto &known = visits[callee->program];
    const auto position = before(context, call.block, context.model.programs[program].first);
    if (!position || (!known.empty() && !isSameWork(context, known.back().call, call.block))) {
      known.clear();
      if (!position)
        continue;
    }
    known.push_back({*position, call.block});
    if (known.size() != 2)
      continue;
    const auto start = startOf(context, *callee);
    const Position &other = known.front().position;
    const bool isOther = other.x->number() != position->x->number() || other.y->number() != position->y->number();
    if (start && isOther)
      tell(known.front(), known.back(), *start, context.model.programs[callee->program].name, context, reporter);
  }
}

} // namespace

extern const Rule positionBeforeSubprogram;
const Rule positionBeforeSubprogram{
    .info = {"position-before-subprogram", Category::Motion, Severity::Warning,
             "Reports positions before the calls of a subprogram that begins at a position of its own."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::position_before_subprogram
