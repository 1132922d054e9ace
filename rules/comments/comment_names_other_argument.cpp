// comment-names-other-argument: `(#11:D: TOOL DIAMETER)`, and D is passed in #7.
#include "findings/rule/rule.h"

#include "base/support/text.h"
#include "rules/flow/flow_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace feedhold::rules::comment_names_other_argument {
namespace {

struct Pair {
  char letter;
  std::uint32_t variable;
  Span comment;
};

/// A comment from its first character on, read piece by piece.
class Reader {
public:
  explicit Reader(std::string_view text) : text_(text) {}
  void skip(std::string_view what) {
    while (at_ < text_.size() && what.find(text_[at_]) != std::string_view::npos)
      ++at_;
  }
  std::optional<char> letter() {
    const bool isOne =
        at_ < text_.size() && isLetter(text_[at_]) && (at_ + 1 == text_.size() || !isLetter(text_[at_ + 1]));
    return isOne ? std::optional(toUpper(text_[at_++])) : std::nullopt;
  }
  std::optional<std::uint32_t> variable() {
    if (at_ >= text_.size() || text_[at_] != '#')
      return std::nullopt;
    const std::size_t first = ++at_;
    std::uint32_t number = 0;
    for (; at_ < text_.size() && isDigit(text_[at_]) && at_ - first < 6; ++at_)
      number = number * 10 + static_cast<std::uint32_t>(text_[at_] - '0');
    return at_ == first ? std::nullopt : std::optional(number);
  }
  /// `-#18`, `-5.`: not the dash in front of a remark.
  bool isDifference() const {
    const std::size_t next = text_.find_first_not_of(" \t", at_ + 1);
    return isAt("-") && next != std::string_view::npos && (text_[next] == '#' || isDigit(text_[next]));
  }
  bool isAt(std::string_view what) const {
    return at_ < text_.size() && what.find(text_[at_]) != std::string_view::npos;
  }

private:
  std::string_view text_;
  std::size_t at_ = 1;
};

/// `(#11:D: ..)`, `(#11 = D)`, `(D #11 ..)`, `(D = #11)`: a table of the arguments has a line for each of them.
std::optional<Pair> pairIn(std::string_view text, Span comment) {
  constexpr std::string_view kBlanks = " \t";
  Reader byNumber(text);
  byNumber.skip(kBlanks);
  if (const auto variable = byNumber.variable()) {
    byNumber.skip(kBlanks);
    if (!byNumber.isAt(":=-"))
      return std::nullopt;
    byNumber.skip(" \t:=-");
    const auto letter = byNumber.letter();
    byNumber.skip(kBlanks);
    return letter && byNumber.isAt(":=-)") ? std::optional(Pair{*letter, *variable, comment}) : std::nullopt;
  }
  Reader byLetter(text);
  byLetter.skip(kBlanks);
  const auto letter = byLetter.letter();
  byLetter.skip(" \t:=-");
  const auto variable = letter ? byLetter.variable() : std::nullopt;
  byLetter.skip(kBlanks);
  const bool isFormula = byLetter.isAt("+*/.[") || byLetter.isDifference();
  return variable && !isFormula ? std::optional(Pair{*letter, *variable, comment}) : std::nullopt;
}

/// What the comments of a program say of its arguments.
std::vector<Pair> pairsOf(const FileContext &context, ProgramId program) {
  std::vector<Pair> found;
  const Program &whole = context.model.programs[program];
  for (BlockId block = whole.first; block < whole.last; block = block.next())
    if (isEmpty(context.tree, block))
      for (const Comment &comment : context.tree.commentsOf(block))
        if (const auto pair = pairIn(context.text(comment.span), comment.span);
            pair && letterOfArgument(context.dialect, pair->variable))
          found.push_back(*pair);
  return found;
}

/// No argument then, or not only.
bool isSet(const FileContext &context, ProgramId program, std::uint32_t variable) {
  return std::ranges::any_of(context.model.variablesOf(program),
                             [&](const VariableUse &use) { return use.write && use.number == variable; });
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const std::vector<Pair> pairs = pairsOf(context, program);
  const auto isRight = [&](const Pair &pair) {
    return letterOfArgument(context.dialect, pair.variable) == pair.letter;
  };
  // Who names his own variables A, B, C in #1, #2, #3 agrees with the letters of arguments by chance.
  const auto isNoChance = [&](const Pair &pair) { return isRight(pair) && pair.letter > 'C'; };
  constexpr std::ptrdiff_t kTable = 2; // lines that show what the others are
  if (std::ranges::count_if(pairs, isRight) < kTable || std::ranges::none_of(pairs, isNoChance))
    return;
  for (const Pair &pair : pairs) {
    if (isRight(pair) || isSet(context, program, pair.variable))
      continue;
    const char own = *letterOfArgument(context.dialect, pair.variable);
    reporter.report({.message = fmt::format("this comment calls `#{}` the argument {}, but it is passed by {}",
                                            pair.variable, pair.letter, own),
                     .span = pair.comment,
                     .notes = {"who writes a call by the comment passes the value to another variable",
                               fmt::format("write {} in the comment, or read the variable of {}", own, pair.letter)}});
  }
}

} // namespace

extern const Rule commentNamesOtherArgument;
const Rule commentNamesOtherArgument{
    .info = {"comment-names-other-argument", Category::Comment, Severity::Warning,
             "Reports a line in a table of arguments that gives a variable the letter of another one."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::comment_names_other_argument
