// unexpected-text: bytes that the control does not know.
#include "findings/rule/other_control.h"

#include "base/support/text.h"
#include "rules/words/letter_for_digit.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace feedhold::rules::unexpected_text {
namespace {

/// `X?` is how templates mark a number to be filled in.
bool isPlaceholder(std::string_view text) { return trimmed(text).find_first_not_of('?') == std::string_view::npos; }

/// `&HE:%` in the first line: what a tape has in front of its `%` is passed over.
bool isTapeLeader(const SyntaxIssue &issue, const FileContext &context) {
  const std::string_view text = context.source.text();
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  return issue.span.end < line.size() && trimmed(line).ends_with('%');
}

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

/// What stands behind a label in the place of an o-word, as far as it is letters.  `enddo` is more than the `END` that
/// could not be read.
std::optional<Span> oWordPlace(const SyntaxIssue &issue, const FileContext &context) {
  const BlockId block = context.tree.blockAt(issue.span.begin);
  const auto words = context.tree.wordsOf(block);
  if (!context.dialect.grammar.oWords || words.size() != 1 || words.front().address() != 'O' ||
      words.front().span().end > issue.span.begin)
    return std::nullopt;
  const std::string_view text = context.text({issue.span.begin, context.tree.blocks[block].end});
  const auto end = std::ranges::find_if_not(text, isLetter);
  return Span{issue.span.begin, issue.span.begin + static_cast<std::uint32_t>(end - text.begin())};
}

/// The o-word that is meant: `o<foo> ebdsub`, `o100 callsub`, and what closes a loop in other languages.
std::optional<std::string_view> oWordMeant(std::string_view text) {
  const std::string written = toLower(text);
  if (written.size() > 12)
    return std::nullopt;
  if (written == "enddo" || written == "wend")
    return "endwhile";
  for (const std::string_view each : kOWords)
    if (distance(written, each) == 1 || (each.size() > 3 && written.starts_with(each)))
      return each;
  return std::nullopt;
}

/// `o100 elseif if [..]`: the o-word itself is right.
bool reportTextBehindOWord(Span place, const FileContext &context, const Reporter &reporter) {
  const std::string word = toLower(context.text(place));
  if (std::ranges::find(kOWords, word) == kOWords.end())
    return false;
  const std::string_view rest = context.text({place.end, context.tree.blocks[context.tree.blockAt(place.begin)].end});
  const std::string_view excess = trimmed(rest.substr(0, rest.find_first_of("[(;")));
  if (excess.empty())
    return false;
  const auto begin = place.end + static_cast<std::uint32_t>(excess.data() - rest.data());
  const Span span{begin, begin + static_cast<std::uint32_t>(excess.size())};
  const bool isBefore = trimmed(rest.substr(0, rest.find('['))) == excess && rest.find('[') != std::string_view::npos;
  reporter.report(
      {.message = isBefore ? fmt::format("{} stands between `{}` and its `[`", context.quoted(span), word)
                           : fmt::format("{} is not part of the o-word `{}`", context.quoted(span), word),
       .span = span,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat))},
       .fixes = {{.title = fmt::format("delete {}", context.quoted(span)), .edits = {{{place.end, span.end}, ""}}}}});
  return true;
}

bool reportOWord(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const std::optional<Span> place = oWordPlace(issue, context);
  if (!place)
    return false;
  if (reportTextBehindOWord(*place, context, reporter))
    return true;
  const auto meant = oWordMeant(context.text(*place));
  if (!meant)
    return false;
  reporter.report({.message = fmt::format("{} is no o-word; did you mean `{}`?", context.quoted(*place), *meant),
                   .span = *place,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat))},
                   .fixes = {{.title = fmt::format("write `{}`", *meant), .edits = {{*place, std::string(*meant)}}}}});
  return true;
}

/// What a printed page, or a keyboard of other letters, has for a sign of the program.
struct Sign {
  std::string_view written;
  std::string_view meant;
};
constexpr std::array<Sign, 7> kSigns = {{{"\u2605", "*"},
                                         {"\u00d7", "*"},
                                         {"\u2217", "*"},
                                         {"\u00f7", "/"},
                                         {"\u2212", "-"},
                                         {"\u2013", "-"},
                                         {"\uff1d", "="}}};
const Sign *signAt(const SyntaxIssue &issue, const FileContext &context) {
  const auto sign = std::ranges::find(kSigns, context.text(issue.span), &Sign::written);
  return sign == kSigns.end() ? nullptr : sign;
}

/// Lines that version control leaves around two versions of some others.
constexpr std::array<std::string_view, 3> kConflictMarks = {"<<<<<<<", "=======", ">>>>>>>"};

/// Which of them the issue stands at; absent: at none, or without one that begins a conflict before it.
std::optional<std::size_t> conflictMarkAt(const SyntaxIssue &issue, const FileContext &context) {
  const Span all{0, issue.span.end};
  const std::string_view before = context.text(all);
  const std::size_t newline = before.rfind('\n', issue.span.begin);
  const std::size_t line = newline == std::string_view::npos ? 0 : newline + 1;
  const std::string_view rest =
      context.text({static_cast<std::uint32_t>(line), context.tree.blocks[context.tree.blockAt(issue.span.begin)].end});
  const auto mark = std::ranges::find_if(kConflictMarks, [&](std::string_view each) { return rest.starts_with(each); });
  if (mark == kConflictMarks.end())
    return std::nullopt;
  const bool isOpen = mark == kConflictMarks.begin() || before.starts_with(kConflictMarks[0]) ||
                      before.find("\n<<<<<<<") != std::string_view::npos;
  return isOpen ? std::optional<std::size_t>(mark - kConflictMarks.begin()) : std::nullopt;
}

void reportConflict(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  std::vector<Label> labels;
  for (const SyntaxIssue &other : context.tree.issues)
    if (other.kind == issue.kind && other.span.begin > issue.span.begin && labels.size() < 2)
      if (const auto mark = conflictMarkAt(other, context); mark == labels.size() + 1)
        labels.push_back({other.span, *mark == 1 ? "the other version begins" : "and ends"});
  reporter.report({.message = "unresolved merge conflict: two versions of these lines stand in the program",
                   .span = issue.span,
                   .labels = std::move(labels),
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat)),
                             "choose one version, and delete the other together with the lines `<<<<<<<`, `=======` "
                             "and `>>>>>>>`"}});
}

/// `IF [#1 GT 2]` on a control whose control words have a label.
bool isUnlabelled(const SyntaxIssue &issue, const FileContext &context) {
  if (issue.kind != SyntaxIssueKind::UnexpectedText || !context.dialect.grammar.oWords ||
      !context.tree.wordsOf(context.tree.blockAt(issue.span.begin)).empty())
    return false;
  const std::string written = toLower(trimmed(context.text(issue.span)));
  const std::string first = written.substr(0, written.find_first_of(" [\t"));
  constexpr std::array<std::string_view, 8> kHeads = {"if",    "elseif",   "else",   "endif",
                                                      "while", "endwhile", "repeat", "endrepeat"};
  return std::ranges::find(kHeads, first) != kHeads.end();
}

/// Once for all of the file: they have one cause.
void reportUnlabelled(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const auto isSame = [&](const SyntaxIssue &other) { return isUnlabelled(other, context); };
  if (std::ranges::find_if(context.tree.issues, isSame)->span.begin != issue.span.begin)
    return;
  const auto others = std::ranges::count_if(context.tree.issues, isSame) - 1;
  reporter.report(
      {.message = others == 0 ? fmt::format("{} has no o-number", context.quoted(issue.span))
                              : fmt::format("{} has no o-number, and {} more control words have none",
                                            context.quoted(issue.span), others),
       .span = issue.span,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat)),
                 "write a label in front of each control word, one for each structure: `o100 if [..]`, `o100 else`, "
                 "`o100 endif`"}});
}

/// `M00 /clamp again`: `/` begins a remark in other languages.
bool isBehindSlash(const SyntaxIssue &issue, const FileContext &context) {
  return issue.kind == SyntaxIssueKind::UnexpectedText && habitAt(issue, context) == ForeignHabit::SlashRemark;
}

/// Once for all of the file: they have one cause.
void reportBehindSlash(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const auto isSame = [&](const SyntaxIssue &other) { return isBehindSlash(other, context); };
  if (std::ranges::find_if(context.tree.issues, isSame)->span.begin != issue.span.begin)
    return;
  const auto others = std::ranges::count_if(context.tree.issues, isSame) - 1;
  const std::string more =
      others == 0 ? "" : fmt::format(", here and in {} more block{}", others, others == 1 ? "" : "s");
  reporter.report({.message = fmt::format("`/` does not begin a remark{}", more),
                   .span = issue.span,
                   .label = "read as program text",
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat)),
                             "put remarks in parentheses"}});
}

/// `01000` as the first block of a file: the number of the program, with a digit for its letter.
bool isProgramNumber(const SyntaxIssue &issue, const FileContext &context) {
  const std::string_view text = context.text(issue.span);
  const BlockId block = context.tree.blockAt(issue.span.begin);
  constexpr std::size_t kShortest = 4; // `0` and three digits
  if (text.size() < kShortest || text.front() != '0' || !std::ranges::all_of(text, isDigit) ||
      !context.tree.wordsOf(block).empty())
    return false;
  for (BlockId before(0); before < block; before = before.next())
    if (!context.tree.wordsOf(before).empty() || !context.tree.statementsOf(before).empty())
      return false;
  return true;
}

void reportProgramNumber(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const Span digit{issue.span.begin, issue.span.begin + 1};
  reporter.report(
      {.message = fmt::format("{} has the digit 0 in the place of the letter O", context.quoted(issue.span)),
       .span = issue.span,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat))},
       .fixes = {{.title = "write the letter O", .edits = {{digit, "O"}}}}});
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (isPlaceholder(context.text(issue.span)) || isTapeLeader(issue, context))
    return;
  if (const auto mark = conflictMarkAt(issue, context)) {
    if (*mark == 0)
      reportConflict(issue, context, reporter);
    return;
  }
  if (isUnlabelled(issue, context))
    return reportUnlabelled(issue, context, reporter);
  if (reportOWord(issue, context, reporter))
    return;
  if (isProgramNumber(issue, context))
    return reportProgramNumber(issue, context, reporter);
  if (isBehindSlash(issue, context))
    return reportBehindSlash(issue, context, reporter);
  if (const Sign *sign = signAt(issue, context)) {
    reporter.report({.message = fmt::format("{} is no sign that the control knows", context.quoted(issue.span)),
                     .span = issue.span,
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat))},
                     .fixes = {{.title = fmt::format("write `{}`", sign->meant),
                                .edits = {{issue.span, std::string(sign->meant)}}}}});
    return;
  }
  if (const auto digits = mistypedDigitsAt(issue.span.begin, context)) {
    reporter.report({.message = fmt::format("{} is not part of a word or statement: {}", context.quoted(issue.span),
                                            describe(*digits)),
                     .span = issue.span,
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat))},
                     .fixes = fixesFor(*digits)});
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
