// unexpected-text: bytes that the control does not know.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace feedhold::rules::unexpected_text {
namespace {

/// `X?` is how templates mark a number to be filled in.
bool isPlaceholder(std::string_view text) { return trimmed(text).find_first_not_of('?') == std::string_view::npos; }

constexpr std::array<std::string_view, 15> kOWords = {"sub",    "endsub", "call",      "return", "if",
                                                      "elseif", "else",   "endif",     "while",  "endwhile",
                                                      "do",     "repeat", "endrepeat", "break",  "continue"};

/// How many letters differ: changed, left out, added or exchanged with the next one.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      cost[i][j] =
          std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[a.size()][b.size()];
}

/// The o-word that is meant by what stands behind a label: `o<foo> ebdsub`, `o100 callsub`.
std::optional<std::string_view> oWordMeant(const SyntaxIssue &issue, const FileContext &context) {
  const auto words = context.tree.wordsOf(context.tree.blockAt(issue.span.begin));
  const std::string written = toLower(trimmed(context.text(issue.span)));
  if (!context.dialect.grammar.oWords || words.size() != 1 || words.front().address() != 'O' || written.size() > 12)
    return std::nullopt;
  for (const std::string_view each : kOWords)
    if (distance(written, each) == 1 || (each.size() > 3 && written.starts_with(each)))
      return each;
  return std::nullopt;
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (isPlaceholder(context.text(issue.span)))
    return;
  if (const auto meant = oWordMeant(issue, context)) {
    reporter.report(
        {.message = fmt::format("{} is no o-word; did you mean `{}`?", context.quoted(issue.span), *meant),
         .span = issue.span,
         .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat))},
         .fixes = {{.title = fmt::format("write `{}`", *meant), .edits = {{issue.span, std::string(*meant)}}}}});
    return;
  }
  reporter.report({.message = fmt::format("{} is not part of a word or statement", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat)),
                             "delete it, or put it in parentheses if it is a remark"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::UnexpectedText};

} // namespace

extern const Rule unexpectedText;
const Rule unexpectedText{.info = {"unexpected-text", Category::Syntax, Severity::Error,
                                   "Reports text that is not part of a word, a statement or a comment."},
                          .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::unexpected_text
