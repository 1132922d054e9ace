// Reads the suppressions of a program: its comments, and the files beside it.
#include "base/support/text.h"
#include "findings/rule/suppression.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace feedhold {

namespace {

constexpr std::string_view kMark = "@ALLOW";
constexpr std::string_view kProgramMark = "@ALLOW-PROGRAM";

bool isNameCharacter(char c) { return isLetter(c) || isDigit(c) || c == '-'; }

/// The head of `rest` as long as `belongs` holds, cut off from `rest`.
template <typename Predicate> std::string_view takeWhile(std::string_view &rest, Predicate belongs) {
  const auto end = std::find_if_not(rest.begin(), rest.end(), belongs);
  const std::string_view head = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
  rest.remove_prefix(head.size());
  return head;
}

/// What stands between the parentheses of a comment.
std::string_view bodyOf(std::string_view comment) {
  if (!comment.empty() && comment.front() == '(')
    comment.remove_prefix(1);
  if (!comment.empty() && comment.back() == ')')
    comment.remove_suffix(1);
  return trimmed(comment);
}

/// `rule, rule reason` -> the rules in lower case, and the reason is what is left in `rest`.
std::vector<std::string> takeRules(std::string_view &rest) {
  std::vector<std::string> rules;
  for (;;) {
    takeWhile(rest, isBlank);
    rules.push_back(toLower(takeWhile(rest, isNameCharacter)));
    takeWhile(rest, isBlank);
    if (!rest.starts_with(','))
      return rules;
    rest.remove_prefix(1);
  }
}

/// A part of the source's text.
std::string decoded(std::string_view part, const SourceFile &source) {
  const auto begin = static_cast<std::uint32_t>(part.data() - source.text().data());
  return source.utf8({begin, begin + static_cast<std::uint32_t>(part.size())});
}

std::vector<Suppression> forEachRule(const std::vector<std::string> &rules, const Suppression &suppression) {
  std::vector<Suppression> found(rules.size(), suppression);
  for (std::size_t i = 0; i < rules.size(); ++i)
    found[i].rule = rules[i];
  return found;
}

/// The block that a suppression on `block` speaks of: itself, or the next one that does something.
BlockId coveredBlock(const SyntaxTree &tree, BlockId block) {
  BlockId covered = block;
  while (covered.index() + 1 < tree.blockCount() && isEmpty(tree, covered))
    covered = covered.next();
  return covered;
}

/// `@ALLOW` or `@ALLOW-PROGRAM`, cut off from `rest`; empty when it is something else.
std::string takeMark(std::string_view &rest) {
  if (!rest.starts_with('@'))
    return {};
  const std::string mark = toUpper(takeWhile(rest, [](char c) { return c == '@' || isNameCharacter(c); }));
  return mark == kMark || mark == kProgramMark ? mark : std::string();
}

/// One for each rule that the comment names; none when it is another comment.
std::vector<Suppression> readComment(const Comment &comment, const FileContext &context) {
  std::string_view rest = bodyOf(context.text(comment.span));
  const std::string mark = takeMark(rest);
  if (mark.empty())
    return {};
  const BlockId block = context.tree.blockAt(comment.span.begin);
  Suppression suppression{.span = comment.span, .first = block, .last = coveredBlock(context.tree, block)};
  if (mark == kProgramMark)
    suppression.wholeProgram = context.model.programOf(block);
  const std::vector<std::string> rules = takeRules(rest);
  suppression.reason = decoded(rest, context.source);
  return forEachRule(rules, suppression);
}

/// The place behind the rules of a file beside the program: `O9101`, `N20`, `N20..N40`, `N20..`.
class PlaceReader {
public:
  PlaceReader(const FileContext &context, Suppression &suppression)
      : model_(context.model), suppression_(suppression) {}

  void take(std::string_view &rest) {
    if (const auto number = takeNumber(rest, 'O'))
      takeProgram(*number);
    const std::string_view before = rest;
    const std::optional<std::uint32_t> first = takeLabel(rest);
    if (!first)
      return;
    const bool isRange = rest.starts_with("..");
    std::optional<std::uint32_t> last;
    if (isRange) {
      rest.remove_prefix(2);
      last = takeLabel(rest);
    }
    if (!rest.empty() && !isBlank(rest.front())) { // `N20A`: the reason begins
      rest = before;
      return;
    }
    setBlocks(*first, isRange, last);
  }

private:
  /// `O9101` and the blanks behind it, when it is a whole word.
  static std::optional<std::uint32_t> takeNumber(std::string_view &rest, char letter) {
    std::string_view ahead = rest;
    const std::optional<std::uint32_t> number = takeDigits(ahead, letter);
    if (!number || (!ahead.empty() && !isBlank(ahead.front())))
      return std::nullopt;
    takeWhile(ahead, isBlank);
    rest = ahead;
    return number;
  }
  static std::optional<std::uint32_t> takeLabel(std::string_view &rest) { return takeDigits(rest, 'N'); }
  static std::optional<std::uint32_t> takeDigits(std::string_view &rest, char letter) {
    if (rest.empty() || toUpper(rest.front()) != letter)
      return std::nullopt;
    std::string_view ahead = rest.substr(1);
    const std::string_view digits = takeWhile(ahead, isDigit);
    std::uint32_t number = 0;
    if (digits.empty() || std::from_chars(digits.data(), digits.data() + digits.size(), number).ec != std::errc())
      return std::nullopt;
    rest = ahead;
    return number;
  }

  void takeProgram(std::uint32_t number) {
    for (std::size_t i = 0; i < model_.programs.size(); ++i)
      if (model_.programs[ProgramId(i)].name.number == number) {
        suppression_.wholeProgram = ProgramId(i);
        return;
      }
    suppression_.missing = fmt::format("program O{} in this file", number);
  }

  std::optional<BlockId> blockOf(std::uint32_t number, BlockId from) {
    const Program &program = model_.programs[*suppression_.wholeProgram];
    for (const SequenceNumber &each : model_.sequenceNumbersIn(from, program.last))
      if (each.number == number)
        return each.block;
    suppression_.missing = fmt::format("block N{} in {}", number, toString(program.name));
    return std::nullopt;
  }

  void setBlocks(std::uint32_t from, bool isRange, std::optional<std::uint32_t> to) {
    if (!suppression_.missing.empty())
      return;
    const Program &program = model_.programs[*suppression_.wholeProgram];
    const std::optional<BlockId> first = blockOf(from, program.first);
    const std::optional<BlockId> last = first && to ? blockOf(*to, *first) : first;
    if (!first || !last)
      return;
    suppression_.first = *first;
    suppression_.last = isRange && !to ? program.last : *last;
    suppression_.wholeProgram.reset();
  }

  const ProgramModel &model_;
  Suppression &suppression_;
};

std::vector<Suppression> readAllowance(const SidecarAllowance &allowance, const FileContracts &contracts,
                                       const FileContext &context) {
  const SourceFile &source = contracts.source(allowance.source);
  std::string_view rest = source.text(allowance.span);
  const std::string mark = takeMark(rest);
  Suppression suppression{.source = allowance.source, .span = allowance.span, .wholeProgram = allowance.program};
  const std::vector<std::string> rules = takeRules(rest);
  if (mark == kMark)
    PlaceReader(context, suppression).take(rest);
  takeWhile(rest, isBlank);
  suppression.reason = decoded(rest, source);
  return forEachRule(rules, suppression);
}

} // namespace

std::vector<Suppression> findSuppressions(const FileContext &context) {
  std::vector<Suppression> found;
  for (const Comment &comment : context.tree.comments)
    for (Suppression &suppression : readComment(comment, context))
      found.push_back(std::move(suppression));
  if (context.file.index() >= context.contracts.size())
    return found;
  const FileContracts &contracts = *context.contracts[context.file.index()];
  for (const SidecarAllowance &allowance : contracts.allowances)
    for (Suppression &suppression : readAllowance(allowance, contracts, context))
      found.push_back(std::move(suppression));
  return found;
}

} // namespace feedhold
