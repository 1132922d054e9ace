// tool-with-coordinates: `G50 S2000 T0101`, `G04 X1. T0202` on a lathe.
#include "rules/words/word_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::rules::tool_with_coordinates {
namespace {

/// Codes that take no T beside them.  Source: alarm 245 of FANUC lathes, "T code not allowed in this block".
constexpr std::array<std::uint16_t, 3> kCodes = {40, 100, 500}; // G04, G10, G50

void check(const Word &tool, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.hasFanucParameters || context.dialect.machine != MachineKind::Turning ||
      hasTooManyWords(context, block) || tool.has(Word::kArgument) || tool.has(Word::kComma) ||
      context.tree.blocks[block].has(Block::kBroken) || context.tree.blocks[block].has(Block::kData) ||
      context.dialect.switches.gCodeSystem != GCodeSystem::A)
    return;
  for (const Word &word : context.tree.wordsOf(block)) {
    const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr;
    if (!code || std::ranges::find(kCodes, code->tenths) == kCodes.end())
      continue;
    reporter.report(
        {.message = fmt::format("{} in the block of {}", context.quoted(tool.span()), context.quoted(word.span())),
         .span = tool.span(),
         .labels = {{word.span(), "takes no T beside it"}},
         .notes = {"the control stops with PS0245 (T code not allowed in this block); only controls older "
                   "than Series 16 take both",
                   "write the T in a block of its own"}});
    return;
  }
}

} // namespace

extern const Rule toolWithCoordinates;
const Rule toolWithCoordinates{.info = {"tool-with-coordinates", Category::Word, Severity::Warning,
                                        "Reports a `T` of a lathe in the block of a `G04`, `G10` or `G50`."},
                               .hooks = {.word = check, .wordAddresses = "T"}};

} // namespace feedhold::rules::tool_with_coordinates
