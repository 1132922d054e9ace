// symbolic-comparison: `=`, `<`, `LT=` where EQ, LT, LE are meant.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules::symbolic_comparison {
namespace {

struct Meaning {
  std::string_view written;
  std::string_view meant;
  FixSafety safety;
};
// A sign alone says what is meant; a mixture such as `LT=` (a `<=` half replaced) is a guess.
constexpr Meaning kMeanings[] = {
    {"=", "EQ", FixSafety::Safe},          {"==", "EQ", FixSafety::Safe},         {"<>", "NE", FixSafety::Safe},
    {"!=", "NE", FixSafety::Safe},         {"<", "LT", FixSafety::Safe},          {">", "GT", FixSafety::Safe},
    {"<=", "LE", FixSafety::Safe},         {">=", "GE", FixSafety::Safe},         {"=<", "LE", FixSafety::Safe},
    {"=>", "GE", FixSafety::Safe},         {"LT=", "LE", FixSafety::NeedsReview}, {"GT=", "GE", FixSafety::NeedsReview},
    {"LE=", "LE", FixSafety::NeedsReview}, {"GE=", "GE", FixSafety::NeedsReview}, {"EQ=", "EQ", FixSafety::NeedsReview},
    {"NE=", "NE", FixSafety::NeedsReview}};

std::vector<FixIt> fixesFor(std::string_view written, Span span) {
  std::string key;
  for (const char c : written)
    if (!isBlank(c))
      key.push_back(toUpper(c));
  for (const Meaning &meaning : kMeanings)
    if (meaning.written == key)
      return {{meaning.safety, fmt::format("write `{}`", meaning.meant), {{span, std::string(meaning.meant)}}}};
  return {};
}

/// `THEN[#33=1]`: the brackets make a condition of the assignment.
bool isBehindThen(const SyntaxIssue &issue, const FileContext &context) {
  const Block &block = context.tree.blocks[context.tree.blockAt(issue.span.begin)];
  std::string before;
  for (const char c : context.text({block.begin, issue.span.begin}))
    if (!isBlank(c))
      before.push_back(toUpper(c));
  const std::size_t then = before.rfind("THEN[");
  return then != std::string::npos && context.text(issue.span) == "=" &&
         before.find_first_not_of("#0123456789", then + 5) == std::string::npos;
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (isBehindThen(issue, context))
    return reporter.report(
        {.message = "an assignment behind `THEN` has no brackets around it",
         .span = issue.span,
         .notes = {"the brackets make an expression of it, in which `=` has no meaning",
                   fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ExpressionFormat)),
                   "leave the brackets out, as in `THEN#100=1`"}});
  reporter.report({.message = fmt::format("{} is not a comparison operator", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ExpressionFormat)),
                             "the comparison operators are `EQ NE GT GE LT LE`"},
                   .fixes = fixesFor(context.text(issue.span), issue.span)});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::SymbolicComparison};

} // namespace

extern const Rule symbolicComparison;
const Rule symbolicComparison{
    .info = {"symbolic-comparison", Category::Expression, Severity::Error,
             "Reports a comparison written with `=`, `<` or `>`: the control only has `EQ NE GT GE LT LE`."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::symbolic_comparison
