// hole-without-position: `G82 Z-1. R2. F50`, and no X or Y above it.
#include "rules/motion/motion_view.h"
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace feedhold::rules::hole_without_position {
namespace {

constexpr std::initializer_list<CodeAction> kCycles = {
    CodeAction::CycleDrill, CodeAction::CycleDwell,   CodeAction::CyclePeck, CodeAction::CycleChipBreak,
    CodeAction::CycleTap,   CodeAction::CycleTapLeft, CodeAction::CycleBore, CodeAction::CycleBoreStop};

bool hasWord(const FileContext &context, BlockId block, std::string_view addresses) {
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    return addresses.find(word.address()) != std::string_view::npos;
  });
}

/// `#1=0` moves nothing; a condition may lead past the hole.
bool onlyAssigns(const FileContext &context, BlockId block) {
  return std::ranges::all_of(context.tree.statementsOf(block), [](const Statement &statement) {
    return std::holds_alternative<Assignment>(statement.node);
  });
}

/// The block may move the tool, or it is not known what it does.
bool mayPosition(const FileContext &context, BlockId block) {
  return hasWord(context, block, "XYUVABC") || context.tree.blocks[block].has(Block::kBroken) ||
         !onlyAssigns(context, block) ||
         findAction(context.tree, block, context.dialect,
                    {CodeAction::Anything, CodeAction::Unmodelled, CodeAction::PlaneZX, CodeAction::PlaneYZ});
}

/// The first hole of a program that runs straight on up to it, and above which nothing says where it is.
std::optional<BlockId> firstHole(ProgramId program, const FileContext &context) {
  const HiddenWork hidden(program, context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    if (mayPosition(context, block) || hidden.isIn(block))
      return std::nullopt;
    if (findAction(context.tree, block, context.dialect, kCycles))
      return hasWord(context, block, "ZR") && !hasWord(context, block, "KL") ? std::optional(block) : std::nullopt;
  }
  return std::nullopt;
}

/// One hole at the place to which the tool was jogged needs no position; a program that positions does.
const Word *positionBehind(BlockId hole, const Program &program, const FileContext &context) {
  for (BlockId block = hole.next(); block < program.last; block = block.next())
    if (!meansOwnWords(context.tree, block, context.dialect) &&
        !findCode(context.tree, block, context.dialect, CodeRole::ReferenceReturn) &&
        !findCode(context.tree, block, context.dialect, CodeRole::MachinePosition))
      for (const Word &word : context.tree.wordsOf(block))
        if (word.address() == 'X' || word.address() == 'Y')
          return &word;
  return nullptr;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling || startedBy(context, program) != StartedBy::Operator)
    return;
  const auto hole = firstHole(program, context);
  const Word *position = hole ? positionBehind(*hole, context.model.programs[program], context) : nullptr;
  if (!position)
    return;
  const Word *cycle = findAction(context.tree, *hole, context.dialect, kCycles);
  reporter.report(
      {.message = fmt::format("{} machines a hole before any X or Y is programmed", context.quoted(cycle->span())),
       .span = context.tree.blocks[*hole].span(),
       .labels = {{position->span(), "the first position"}},
       .notes = {"a cycle with Z and R machines a hole where the tool stands, wherever that is",
                 "go to the position above the cycle, or write X and Y in its block; to set only the "
                 "depths, write `L0` or `K0`"}});
}

} // namespace

extern const Rule holeWithoutPosition;
const Rule holeWithoutPosition{
    .info = {"hole-without-position", Category::Motion, Severity::Warning,
             "Reports a canned cycle that machines a hole before the program has gone to any position."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::hole_without_position
