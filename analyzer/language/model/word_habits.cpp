#include "language/model/word_habits.h"

#include "language/model/block_facts.h"

#include <algorithm>
#include <string_view>

namespace feedhold {

namespace {

bool isLength(const Word &word, const Dialect &dialect) {
  return word.isNumber() && !word.has(Word::kComma) && !word.number().isZero() &&
         formatOf(dialect, word.address()).kind == AddressKind::Length;
}

/// The words of the block are coordinates, not arguments, data, seconds or settings of a cycle.
bool holdsCoordinates(const SyntaxTree &tree, BlockId block, const Dialect &dialect) {
  return !tree.blocks[block].has(Block::kData) && !meansOwnWords(tree, block, dialect) &&
         !findCode(tree, block, dialect, CodeRole::Dwell) && !findCode(tree, block, dialect, CodeRole::Contour);
}

bool isEndPoint(const Word &word, const Dialect &dialect) {
  return formatOf(dialect, word.address()).kind == AddressKind::Length && !word.has(Word::kComma);
}

bool isCentre(const Word &word) {
  return std::string_view("IJKR").find(word.address()) != std::string_view::npos && !word.has(Word::kComma);
}

} // namespace

WrittenLengths lengthsOf(const SyntaxTree &tree, const Dialect &dialect) {
  WrittenLengths lengths;
  for (std::size_t i = 0; i < tree.blockCount(); ++i)
    for (const Word &word : tree.wordsOf(BlockId(i))) {
      if (!isLength(word, dialect))
        continue;
      if (word.has(Word::kPoint)) {
        ++lengths.withPoint;
        lengths.wholeWithPoint += word.number().isInteger() ? 1 : 0;
      } else if (holdsCoordinates(tree, BlockId(i), dialect)) {
        lengths.withoutPoint.push_back(tree.idOf(word));
      }
    }
  return lengths;
}

const Word *arcWithoutCentre(const SyntaxTree &tree, BlockId block, const Dialect &dialect) {
  const auto words = tree.wordsOf(block);
  const Word *arc = words.size() < 2 ? nullptr : findCode(tree, block, dialect, CodeRole::Arc);
  if (!arc || std::any_of(words.begin(), words.end(), isCentre) || meansOwnWords(tree, block, dialect))
    return nullptr;
  const bool hasEnd =
      std::any_of(words.begin(), words.end(), [&](const Word &word) { return isEndPoint(word, dialect); });
  return hasEnd ? arc : nullptr;
}

WrittenMCodes mCodesOf(const SyntaxTree &tree, BlockId block) {
  WrittenMCodes codes;
  for (const Word &word : tree.wordsOf(block)) {
    if (word.address() != 'M' || !word.isCode() || word.has(Word::kAfterThen) || word.has(Word::kAfterSkip))
      continue;
    codes.first = codes.first ? codes.first : &word;
    codes.last = &word;
    ++codes.count;
  }
  return codes;
}

} // namespace feedhold
