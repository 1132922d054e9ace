// lower-case: `g01 x10.`; one finding for a file.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::lower_case {
namespace {

/// What must keep its letters: comments and printed text, in order of the text.
std::vector<Span> keptIn(const FileContext &context, BlockId block) {
  std::vector<Span> kept;
  for (const Comment &comment : context.tree.commentsOf(block))
    kept.push_back(comment.span);
  for (const Statement &statement : context.tree.statementsOf(block))
    if (const auto *print = std::get_if<Print>(&statement.node))
      kept.push_back(print->format);
  std::sort(kept.begin(), kept.end());
  return kept;
}

void addEdit(Span piece, const FileContext &context, std::vector<Edit> &edits) {
  std::string capitals = toUpper(context.text(piece));
  if (capitals != context.text(piece))
    edits.push_back({piece, std::move(capitals)});
}

void addEdits(Span run, const FileContext &context, std::vector<Edit> &edits) {
  for (const Span kept : keptIn(context, context.tree.blockAt(run.begin))) {
    if (kept.begin < run.begin || kept.end > run.end)
      continue;
    addEdit({run.begin, kept.begin}, context, edits);
    run.begin = kept.end;
  }
  addEdit(run, context, edits);
}

void check(const FileContext &context, const Reporter &reporter) {
  const auto &runs = context.tree.lowerCase;
  if (runs.empty() || context.dialect.grammar.smallLetters)
    return;
  FixIt fix{FixSafety::Safe, "convert to upper case", {}};
  for (const Span run : runs)
    addEdits(run, context, fix.edits);
  reporter.report({.message = runs.size() == 1
                                  ? std::string("lower-case letters outside a comment")
                                  : fmt::format("lower-case letters outside comments, in {} blocks", runs.size()),
                   .span = runs.front(),
                   .notes = {"older controls do not read lower-case letters and stop"},
                   .fixes = {std::move(fix)}});
}

} // namespace

extern const Rule lowerCase;
const Rule lowerCase{.info = {"lower-case", Category::Word, Severity::Info,
                              "Reports program text in lower case, which older controls do not read."},
                     .hooks = {.file = check}};

} // namespace feedhold::rules::lower_case
