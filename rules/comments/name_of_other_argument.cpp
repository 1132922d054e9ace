// name-of-other-argument: `; #3: Startlocation` in the head, and `#<startLoc> = #1`.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace feedhold::rules::name_of_other_argument {
namespace {

constexpr std::uint32_t kLastArgument = 30; // of a call by o-word
constexpr std::size_t kShortestName = 4;    // letters: shorter ones fit too much

std::string lettersOf(std::string_view text) {
  std::string letters;
  for (const char c : text)
    if (isLetter(c))
      letters += toUpper(c);
  return letters;
}

/// A line of the table of arguments.
struct Line {
  std::string text;  // its letters
  std::string first; // those of its first word
  Span comment;
};
using Table = std::map<std::uint32_t, Line>;

/// `; #3: Startlocation`, `(#3 = start location)`
std::optional<std::pair<std::uint32_t, Line>> lineIn(std::string_view comment, Span span) {
  const std::string_view text = trimmed(comment.substr(std::min(comment.find_first_not_of("(; \t"), comment.size())));
  const std::size_t end = text.starts_with('#') ? std::min(text.find_first_not_of("0123456789", 1), text.size()) : 0;
  if (end < 2 || end > 3)
    return std::nullopt;
  std::uint32_t number = 0;
  for (const char digit : text.substr(1, end - 1))
    number = number * 10 + static_cast<std::uint32_t>(digit - '0');
  std::string_view rest = text.substr(end);
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t:=-"), rest.size()));
  const std::string_view meaning = rest.substr(0, rest.find_first_of("(=)"));
  if (number == 0 || number > kLastArgument || meaning.empty() || !isLetter(meaning.front()))
    return std::nullopt;
  return std::pair{number, Line{lettersOf(meaning), lettersOf(meaning.substr(0, meaning.find_first_of(" \t,"))), span}};
}

/// Empty where two lines speak of one argument: the file has several tables.
Table tableOf(const FileContext &context) {
  Table table;
  for (BlockId block(0); block.index() < context.tree.blockCount(); block = block.next())
    for (const Comment &comment : context.tree.commentsOf(block))
      if (const auto line = lineIn(context.text(comment.span), comment.span)) {
        const auto [known, isNew] = table.emplace(*line);
        if (!isNew && known->second.text != line->second.text)
          return {};
      }
  return table;
}

/// The name is the beginning of what the line says, or begins with its first word.
bool isNamedBy(const std::string &name, const Line &line) {
  return line.text.starts_with(name) || (line.first.size() > kShortestName && name.starts_with(line.first));
}

void checkAssignment(const Assignment &assignment, const Table &table, const FileContext &context,
                     const Reporter &reporter) {
  const auto *target = std::get_if<NamedVariable>(&context.tree.expressions[assignment.target].node);
  const auto number = variableNumber(context.tree, unwrapped(context.tree, assignment.value));
  const std::string name = target ? lettersOf(context.text(target->name)) : "";
  const auto own = number ? table.find(*number) : table.end();
  if (name.size() < kShortestName || own == table.end() || isNamedBy(name, own->second))
    return;
  const auto other = std::ranges::find_if(table, [&](const auto &line) { return isNamedBy(name, line.second); });
  if (other == table.end())
    return;
  const Span value = context.tree.expressions[assignment.value].span;
  reporter.report(
      {.message = fmt::format("{} takes {}, and is #{} in the list of arguments",
                              context.quoted(context.tree.expressions[assignment.target].span), context.quoted(value),
                              other->first),
       .span = value,
       .labels = {{other->second.comment, "the argument of that name"}, {own->second.comment, "the one that is taken"}},
       .notes = {"the subroutine works with the value of another argument", "correct the number, or the list"}});
}

void check(const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.grammar.namedParameters)
    return;
  const Table table = tableOf(context);
  if (table.empty())
    return;
  for (BlockId block(0); block.index() < context.tree.blockCount(); block = block.next())
    for (const Statement &statement : context.tree.statementsOf(block))
      if (const auto *assignment = std::get_if<Assignment>(&statement.node))
        checkAssignment(*assignment, table, context, reporter);
}

} // namespace

extern const Rule nameOfOtherArgument;
const Rule nameOfOtherArgument{
    .info = {"name-of-other-argument", Category::Comment, Severity::Warning,
             "Reports a named parameter that takes another argument than the list in the remarks gives its name."},
    .hooks = {.file = check}};

} // namespace feedhold::rules::name_of_other_argument
