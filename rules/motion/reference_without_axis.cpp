// reference-without-axis: `G91`, `G28`, `X0`, `Z0`: four blocks that were to be one.
#include "findings/rule/dead_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace feedhold::rules::reference_without_axis {
namespace {

/// Nothing but codes: `G28`, `G91 G28`, `N10 G91`.
bool holdsOnlyCodes(BlockId block, const FileContext &context) {
  return context.tree.statementsOf(block).empty() &&
         std::ranges::all_of(context.tree.wordsOf(block),
                             [](const Word &word) { return word.isCode() || word.address() == 'N'; });
}

/// Nothing but axes, all of them 0.
const Word *zeroAxis(BlockId block, std::string_view axes, const FileContext &context) {
  const auto words = context.tree.wordsOf(block);
  const bool isZero = std::ranges::all_of(words, [&](const Word &word) {
    return axes.find(word.address()) != std::string_view::npos && word.isNumber() && word.number().isZero();
  });
  return isZero && !words.empty() && context.tree.statementsOf(block).empty() ? &words.front() : nullptr;
}

std::optional<BlockId> behind(BlockId block, const Program &program, const FileContext &context) {
  for (BlockId each = block.next(); each < program.last; each = each.next())
    if (hasContent(context, each))
      return each;
  return std::nullopt;
}

bool isIncremental(BlockId block, const Program &program, const FileContext &context) {
  if (findAction(context.tree, block, context.dialect, {CodeAction::Incremental}))
    return true;
  for (std::uint32_t i = block.index(); i-- > program.first.index();)
    if (const BlockId each(i); hasContent(context, each))
      return holdsOnlyCodes(each, context) &&
             findAction(context.tree, each, context.dialect, {CodeAction::Incremental}) != nullptr;
  return false;
}

bool namesAxis(BlockId block, const FileContext &context) {
  return std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
    return std::string_view("XYZABCUVWH").find(word.address()) != std::string_view::npos;
  });
}

/// `G28 G91 G0.0`: the second G of a group, or a rapid with a point, was to be an axis.  A bare `G28` is the habit of
/// shops whose control returns all axes.
const Word *slip(BlockId block, const FileContext &context) {
  std::array<bool, 256> groups{};
  for (const Word &word : context.tree.wordsOf(block)) {
    const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr;
    if (!code || code->group == 0)
      continue;
    if (groups[code->group] || (code->action == CodeAction::Rapid && word.has(Word::kPoint)))
      return &word;
    groups[code->group] = true;
  }
  return nullptr;
}

/// Without a word that makes the block mean something else.
void checkBare(const Word &code, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (namesAxis(block, context) || context.tree.blocks[block].has(Block::kBroken) ||
      meansOwnWords(context.tree, block, context.dialect) || !context.model.callsIn(block, block.next()).empty())
    return;
  const Word *other = slip(block, context);
  if (!other)
    return;
  reporter.report({.message = fmt::format("{} names no axis", context.quoted(code.span())),
                   .span = code.span(),
                   .labels = {{other->span(), "was this to be an axis?"}},
                   .notes = {"without an axis most controls return none: the tool stays where it is, and what comes "
                             "next, such as a tool change, happens there",
                             fmt::format("write the axes in this block, such as `G91 {} {}`", context.text(code.span()),
                                         context.dialect.machine == MachineKind::Turning ? "U0 W0" : "Z0")}});
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *code =
      findAction(context.tree, block, context.dialect, {CodeAction::ReferenceReturn, CodeAction::SecondReference});
  if (!code || context.dialect.grammar.oWords) // LinuxCNC returns all axes
    return;
  if (!holdsOnlyCodes(block, context))
    return checkBare(*code, block, context, reporter);
  const Program &program = context.model.programs[context.model.programOf(block)];
  const auto next = behind(block, program, context);
  const bool isTurning = context.dialect.machine == MachineKind::Turning;
  const Word *axis = next ? zeroAxis(*next,
                                     isIncremental(block, program, context) ? "XYZABCUVW"
                                     : isTurning                            ? "UW"
                                                                            : "",
                                     context)
                          : nullptr;
  if (!axis)
    return checkBare(*code, block, context, reporter);
  reporter.report({.message = fmt::format("{} names no axis: {} stands in a block of its own",
                                          context.quoted(code->span()), context.quoted(axis->span())),
                   .span = code->span(),
                   .labels = {{context.tree.blocks[*next].span(), "this block moves nothing"}},
                   .notes = {"without an axis some controls return none, and others all of them at once",
                             "write the axes in the block of the code"}});
}

} // namespace

extern const Rule referenceWithoutAxis;
const Rule referenceWithoutAxis{.info = {"reference-without-axis", Category::Motion, Severity::Warning,
                                         "Reports a reference return without axes when the next block has them, or "
                                         "another code stands where they should."},
                                .hooks = {.block = check}};

} // namespace feedhold::rules::reference_without_axis
