// comma-between-words: `X0,Y0.375`.
#include "findings/rule/dead_blocks.h"
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <string_view>

namespace feedhold::rules::comma_between_words {
namespace {

/// Behind a comma stand corners, chamfers, angles, and on some controls repeats and speeds of cycles; never these.
constexpr std::string_view kNever = "XYZUVWGMFTN";

struct Found {
  const Word *first = nullptr;
  int count = 0;
};

Found findIn(const FileContext &context) {
  Found found;
  for (BlockId block(0); block.index() < context.tree.blockCount(); block = block.next()) {
    if (!isRead(context.tree.blocks[block]))
      continue;
    for (const Word &word : context.tree.wordsOf(block)) {
      if (!word.has(Word::kComma) || kNever.find(word.address()) == std::string_view::npos)
        continue;
      found.first = found.first ? found.first : &word;
      ++found.count;
    }
  }
  return found;
}

void check(const FileContext &context, const Reporter &reporter) {
  const Found found = findIn(context);
  if (!found.first)
    return;
  Diagnostic diagnostic{
      .message = fmt::format("{} begins with a comma", context.quoted(found.first->span())),
      .span = found.first->span(),
      .notes = {"a comma does not separate words: the control stops here with an alarm; it stands only before a "
                "corner or an angle, such as `,R2.`",
                "delete the comma"}};
  if (found.count > 1)
    diagnostic.notes.push_back(fmt::format("the file has {} such words", found.count));
  reporter.report(std::move(diagnostic));
}

} // namespace

extern const Rule commaBetweenWords;
const Rule commaBetweenWords{.info = {"comma-between-words", Category::Word, Severity::Error,
                                      "Reports a comma before a word that takes none, such as `X0,Y1.`."},
                             .hooks = {.file = check}};

} // namespace feedhold::rules::comma_between_words
