// What numbers a word has: of the text, or of variables that the program itself sets.
#pragma once

#include "findings/rule/flow_path.h"
#include "findings/rule/rule.h"

#include <limits>
#include <vector>

namespace feedhold::rules {

/// The numbers that the control takes, both ends included.
struct AllowedNumbers {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool contains(double value) const { return least <= value && value <= most; }
};

/// In how many of the runs that come to a word its number is not allowed.
enum class Outside : std::uint8_t { Never, Sometimes, Always };
/// Sometimes: only of a value that the program itself chooses from a few.  A vacant one is no word at all.
Outside outsideOf(const AbstractValue &value, const AllowedNumbers &allowed);

/// A number that is not allowed, to be shown.
double wrongNumberOf(const AbstractValue &value, const AllowedNumbers &allowed);

struct ComputedWord {
  const Word *word;
  BlockId block;
  NodeId node;
  const AbstractValue *value;
};
/// The words with a variable or an expression in the blocks that are reached; no arguments of calls.
std::vector<ComputedWord> computedWordsOf(const FlowFacts &facts);

/// For Diagnostic::flow: how a run comes to a word that is always outside.
std::vector<Label> pathOf(const FlowFacts &facts, const ComputedWord &computed, Outside outside);

/// As in a file that has lost its line ends: rules that look at all words of a block for each of them leave it alone.
inline constexpr std::size_t kMostWords = 100;
inline bool hasTooManyWords(const FileContext &context, BlockId block) {
  return context.tree.wordsOf(block).size() > kMostWords;
}

/// "is -3", "can be -3": of a computed word that is sometimes or always outside.
std::string describeNumber(const AbstractValue &value, const AllowedNumbers &allowed, Outside outside);

} // namespace feedhold::rules
