// lower-case: `g01 x10.`; one finding for a file.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const FileContext &context, const Reporter &reporter) {
  const auto &runs = context.tree.lowerCase;
  if (runs.empty())
    return;
  FixIt fix{FixSafety::Safe, "write capital letters", {}};
  for (const Span run : runs)
    fix.edits.push_back({run, toUpper(context.text(run))});
  reporter.report({.message = runs.size() == 1
                                  ? std::string("small letters outside of a comment")
                                  : fmt::format("small letters outside of comments, in {} blocks", runs.size()),
                   .span = runs.front(),
                   .notes = {"older controls do not take them"},
                   .fixes = {std::move(fix)}});
}

} // namespace

extern const Rule lowerCase;
const Rule lowerCase{.info = {"lower-case", Category::Word, Severity::Info,
                              "Reports program text in lower case, which older controls do not read."},
                     .hooks = {.file = check}};

} // namespace feedhold::rules
