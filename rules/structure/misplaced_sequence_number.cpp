// misplaced-sequence-number: `G01 X10. N20`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::misplaced_sequence_number {
namespace {

/// Blocks in which N is data or an argument.
bool ownsItsWords(const FileContext &context, BlockId block) {
  for (const CodeRole role : {CodeRole::DataSetting, CodeRole::MacroCall, CodeRole::ModalCall, CodeRole::ModalCallEach})
    if (findCode(context.tree, block, context.dialect, role))
      return true;
  return context.tree.blocks[block].has(Block::kData);
}

/// What stands in the block before the word: the first word or statement other than the head of a program.
std::optional<Span> contentBefore(const Word &word, BlockId block, const FileContext &context) {
  const auto statements = context.tree.statementsOf(block);
  if (!statements.empty() && statements.front().span.begin < word.span().begin)
    return statements.front().span;
  for (const Word &other : context.tree.wordsOf(block)) {
    if (other.span().begin >= word.span().begin)
      return std::nullopt;
    if (other.address() != 'O' && other.form() != WordForm::Name)
      return other.span();
  }
  return std::nullopt;
}

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (word.form() == WordForm::Missing || ownsItsWords(context, block)) // missing-value tells of it
    return;
  const auto before = contentBefore(word, block, context);
  if (!before)
    return;
  const bool stops = context.dialect.behaviour.stopsAtStrayWords;
  reporter.report(
      {.message = fmt::format("sequence number {} is not at the head of its block", context.quoted(word.span())),
       .span = word.span(),
       .labels = {{*before, "the block begins before it"}},
       .notes = {stops ? "the control stops with an error: bad character"
                       : "whether a jump finds the block depends on the control",
                 "put it first, or on a new line if the line end was lost"}},
      stops ? Severity::Error : Severity::Warning);
}

} // namespace

extern const Rule misplacedSequenceNumber;
const Rule misplacedSequenceNumber{.info = {"misplaced-sequence-number", Category::Structure, Severity::Warning,
                                            "Reports a sequence number that is not at the head of its block."},
                                   .hooks = {.word = check, .wordAddresses = "N"}};

} // namespace feedhold::rules::misplaced_sequence_number
