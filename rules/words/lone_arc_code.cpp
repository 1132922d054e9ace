// lone-arc-code: `G40 G2`, where `G28` is meant.
#include "rules/words/block_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace feedhold::rules::lone_arc_code {
namespace {

bool hasWord(const FileContext &context, BlockId block, std::string_view addresses) {
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    return addresses.find(word.address()) != std::string_view::npos && !word.has(Word::kComma);
  });
}

constexpr std::string_view kBesideMotion = "NGMFSTHDO";

/// The arc code of a block that moves nothing.
const Word *loneArc(const FileContext &context, BlockId block) {
  const Block &its = context.tree.blocks[block];
  if (its.has(Block::kData) || its.has(Block::kBroken) || meansOwnWords(context, block))
    return nullptr;
  const Word *arc = findCode(context.tree, block, context.dialect, CodeRole::Arc);
  const bool isAlone = std::ranges::all_of(context.tree.wordsOf(block), [](const Word &word) {
    return kBesideMotion.find(word.address()) != std::string_view::npos && !word.has(Word::kArgument);
  });
  return arc && isAlone && !arc->has(Word::kAfterThen) ? arc : nullptr;
}

/// The arcs that the code is for follow in blocks of their own, or may do so in another program.
bool isForLaterBlocks(const FileContext &context, BlockId block) {
  const Program &program = context.model.programs[context.model.programOf(block)];
  for (BlockId next = block.next(); next < program.last; next = next.next()) {
    if (!context.model.callsIn(next, next.next()).empty() || context.tree.blocks[next].has(Block::kBroken) ||
        findCode(context.tree, next, context.dialect, CodeRole::Return))
      return true;
    if (findCode(context.tree, next, context.dialect, CodeRole::Motion) ||
        findCode(context.tree, next, context.dialect, CodeRole::Arc) ||
        findCode(context.tree, next, context.dialect, CodeRole::ProgramEnd))
      return false;
    if (hasWord(context, next, "IJKR"))
      return true;
    if (hasWord(context, next, "XYZUVWABC"))
      return false;
  }
  return true;
}

/// `G02 R.5`: the arc ends where it begins.
const Word *radiusAlone(const FileContext &context, BlockId block) {
  const Block &its = context.tree.blocks[block];
  const Word *radius = findWord(context.tree, block, 'R');
  if (!radius || its.has(Block::kData) || its.has(Block::kBroken) || meansOwnWords(context, block))
    return nullptr;
  const Word *arc = findCode(context.tree, block, context.dialect, CodeRole::Arc);
  const bool isAlone = std::ranges::all_of(context.tree.wordsOf(block), [&](const Word &word) {
    const bool isCode = word.address() == 'G' && word.isCode();
    const Code *code = isCode ? codeOf(word, context.dialect) : nullptr;
    const bool isOther = isCode && &word != arc && (!code || code->role != CodeRole::Plain);
    return (&word == radius || kBesideMotion.find(word.address()) != std::string_view::npos) && !isOther &&
           !word.has(Word::kArgument) && !word.has(Word::kComma);
  });
  return arc && isAlone && !arc->has(Word::kAfterThen) ? radius : nullptr;
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const bool stops = context.dialect.behaviour.stopsAtStrayWords; // at any arc without an end or a centre
  if (const Word *radius = radiusAlone(context, block)) {
    reporter.report(
        {.message = fmt::format("the arc with {} has no end point, so nothing moves", context.quoted(radius->span())),
         .span = radius->span(),
         .notes =
             {stops ? "the control stops with an error: a radius needs an end point, by the axes of the plane in force"
                    : "a radius needs an end point: `X` and `Y`, or those of the plane in force"}},
        stops ? Severity::Error : Severity::Warning);
    return;
  }
  const Word *arc = loneArc(context, block);
  if (!arc || (!stops && isForLaterBlocks(context, block)))
    return;
  reporter.report(
      {.message = fmt::format("{} has no end point and no centre, so nothing moves", context.quoted(arc->span())),
       .span = arc->span(),
       .notes = {stops ? "the control stops with an error"
                       : "the arc mode stays in force for the coordinates of later blocks",
                 "check whether another code was meant, such as G20, G28 or M03; else delete it"}},
      stops ? Severity::Error : Severity::Warning);
}

} // namespace

extern const Rule loneArcCode;
const Rule loneArcCode{.info = {"lone-arc-code", Category::Word, Severity::Warning,
                                "Reports a `G02` or `G03` in a block without coordinates, when no arc follows for "
                                "which it sets the mode, or when it has a radius."},
                       .hooks = {.block = check}};

} // namespace feedhold::rules::lone_arc_code
