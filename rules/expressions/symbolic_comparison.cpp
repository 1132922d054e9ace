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

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
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
