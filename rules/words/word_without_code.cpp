// word-without-code: `M65 P1 L3` where a word that no code of its block takes stops the control.
#include "rules/words/block_words.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <span>
#include <string_view>

namespace feedhold::rules::word_without_code {
namespace {

/// Codes in tenths that take a word, as LinuxCNC's messages about the word name them.
struct Takers {
  char letter;
  std::string_view names;
  std::span<const std::uint16_t> gCodes;
  std::span<const std::uint16_t> mCodes;
};
constexpr std::array<std::uint16_t, 11> kOfD = {410, 411, 420, 421, 520, 700, 710, 711, 712, 720, 960};
constexpr std::array<std::uint16_t, 3> kOfH = {430, 432, 760};
constexpr std::array<std::uint16_t, 18> kOfL = {52,  100, 410, 411, 420, 421, 730, 740, 760,
                                                810, 820, 830, 840, 850, 860, 870, 880, 890};
constexpr std::array<std::uint16_t, 2> kOfLByM = {660, 980};
constexpr std::array<std::uint16_t, 9> kOfI = {20, 30, 50, 51, 52, 100, 331, 760, 870};
constexpr std::array<std::uint16_t, 8> kOfJ = {20, 30, 50, 51, 52, 100, 760, 870};
constexpr std::array<std::uint16_t, 6> kOfK = {20, 30, 330, 331, 760, 870};
constexpr std::array kTakers = {
    Takers{'D', "G41, G42 or G96", kOfD, {}},
    Takers{'H', "G43 or G76", kOfH, {}},
    Takers{'I', "G2, G3, G5, G5.1, G10, G33.1, G76 or G87", kOfI, {}},
    Takers{'J', "G2, G3, G5, G5.1, G10, G76 or G87", kOfJ, {}},
    Takers{'K', "G2, G3, G33, G33.1, G76 or G87", kOfK, {}},
    Takers{'L', "G10, G41, G42, a canned cycle, M66 or M98", kOfL, kOfLByM},
};

bool takes(const Takers &takers, const Code &code, char address) {
  const auto codes = address == 'G' ? takers.gCodes : takers.mCodes;
  return std::ranges::find(codes, code.tenths) != codes.end();
}

/// `G1 X5 K2`: the movement is stated, so that no arc is in force in the block.
bool statesStraightMove(BlockId block, const FileContext &context) {
  return findAction(context.tree, block, context.dialect, {CodeAction::Rapid, CodeAction::Linear, CodeAction::Skip}) !=
         nullptr;
}

/// Behind axis words the movement in force may be a cycle; a code that is not in the tables may be a remapped one.
bool mayBeTaken(const Takers &takers, BlockId block, const FileContext &context) {
  constexpr std::string_view kAxes = "XYZABCUVW";
  const bool isOfArc = takers.letter == 'I' || takers.letter == 'J' || takers.letter == 'K';
  if (isOfArc && !statesStraightMove(block, context))
    return true;
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    if (kAxes.find(word.address()) != std::string_view::npos)
      return takers.letter == 'L';
    if (word.has(Word::kComma))
      return true;
    const Code *code = word.isCode() ? codeOf(word, context.dialect) : nullptr;
    return word.isCode() && (!code || takes(takers, *code, word.address()));
  });
}

/// Many codes take P; none does in a block of its own, where `G4 P2` was meant.
void checkAlone(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  const bool isAlone = std::ranges::all_of(
      context.tree.wordsOf(block), [&](const Word &other) { return &other == &word || other.address() == 'N'; });
  if (!isAlone || !context.tree.statementsOf(block).empty() || !context.model.callsIn(block, block.next()).empty())
    return;
  reporter.report({.message = fmt::format("no code stands beside {}", context.quoted(word.span())),
                   .span = word.span(),
                   .notes = {"the control stops with an error: P needs a code such as G4 in its block",
                             "write the code, as in `G4 P2` for a wait of 2 seconds"}});
}

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  const Block &its = context.tree.blocks[block];
  if (!context.dialect.grammar.oWords || its.has(Block::kBroken) || word.has(Word::kArgument))
    return;
  if (word.address() == 'P')
    return checkAlone(word, block, context, reporter);
  const Takers &takers = *std::ranges::find(kTakers, word.address(), &Takers::letter);
  if (!context.model.callsIn(block, block.next()).empty() || mayBeTaken(takers, block, context))
    return;
  reporter.report(
      {.message = fmt::format("no code of this block takes {}", context.quoted(word.span())),
       .span = word.span(),
       .notes = {fmt::format("the control stops with an error: {} stands only with {}", takers.letter, takers.names),
                 "correct the code of the block, or delete the word"}});
}

} // namespace

extern const Rule wordWithoutCode;
const Rule wordWithoutCode{
    .info = {"word-without-code", Category::Word, Severity::Error,
             "Reports a `D`, `H`, `I`, `J`, `K`, `L` or `P` word in a block without a code that takes it, where "
             "the control stops for that."},
    .hooks = {.word = check, .wordAddresses = "DHIJKLP"}};

} // namespace feedhold::rules::word_without_code
